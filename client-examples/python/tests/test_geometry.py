"""Arcs, bulges, rings and paths, without a server."""

import math
import random

import pytest

from traverse import Arc, Path, Point, Ring

SEEDS = range(200)


@pytest.mark.parametrize("seed", SEEDS)
def test_a_bulge_survives_the_way_through_centre_and_sweep(seed: int) -> None:
    chance = random.Random(seed)
    start, end = ((chance.uniform(-50, 50), chance.uniform(-50, 50)) for _ in range(2))
    bulge = chance.choice([-1, 1]) * chance.choice([1, 0.5, chance.uniform(0.01, 1)])
    arc = Arc.from_bulge(start, end, bulge)
    assert arc.bulge == pytest.approx(bulge, rel=1e-12)
    assert arc.radius_mm(start) == pytest.approx(arc.radius_mm(end), rel=1e-9)
    assert arc.at(start, arc.sweep_rad) == pytest.approx(end, abs=1e-9)
    again = Arc.about(start, end, arc.center, arc.clockwise)
    assert again.sweep_rad == pytest.approx(arc.sweep_rad, abs=1e-9)
    # Counter-clockwise arcs bulge to the right of their chord.
    middle = arc.at(start, arc.sweep_rad / 2)
    side = (end[0] - start[0]) * (middle[1] - start[1]) - (end[1] - start[1]) * (middle[0] - start[0])
    assert (side < 0) == (bulge > 0)


@pytest.mark.parametrize("tolerance_mm", [1, 0.1, 0.001])
@pytest.mark.parametrize("seed", range(20))
def test_chords_keep_the_tolerance(seed: int, tolerance_mm: float) -> None:
    chance = random.Random(seed)
    center = Point(chance.uniform(-9, 9), chance.uniform(-9, 9))
    arc = Arc(center, chance.random() < 0.5, chance.uniform(0.01, 2 * math.pi))
    start = Point(center.x_mm + 25, center.y_mm)
    points = [start, *arc.points(start, arc.at(start, arc.sweep_rad), tolerance_mm)]
    for one, two in zip(points, points[1:]):
        middle = ((one.x_mm + two.x_mm) / 2, (one.y_mm + two.y_mm) / 2)
        assert 25 - math.dist(center, middle) <= tolerance_mm * (1 + 1e-9)
    length = sum(math.dist(one, two) for one, two in zip(points, points[1:]))
    assert length <= arc.length_mm(start) * (1 + 1e-12)


def test_lengths_are_exact() -> None:
    assert Ring.rectangle(1, 2, 3, 4).length_mm == 14
    assert Ring.circle((7, 8), 10).length_mm == pytest.approx(20 * math.pi)
    assert Path.begin((1, 1)).arc_to((1, 1), center=(3, 1)).length_mm == pytest.approx(4 * math.pi)
    assert Path.begin((1, 0)).arc_to((0, 1), center=(0, 0), clockwise=True).length_mm == pytest.approx(1.5 * math.pi)


@pytest.mark.parametrize("clockwise", [False, True])
@pytest.mark.parametrize("turn", [0.1, 0.5, 0.9, 1.0])
def test_a_ring_follows_its_path(clockwise: bool, turn: float) -> None:
    sweep = turn * 2 * math.pi * (-1 if clockwise else 1)
    end = (5 * math.cos(sweep), 5 * math.sin(sweep)) if turn < 1 else (5.0, 0.0)
    path = Path.begin((5, 0)).arc_to(end, center=(0, 0), clockwise=clockwise)
    ring = Ring.from_path(path)
    chord = math.dist(path.end, path.start)
    assert ring.length_mm == pytest.approx(path.length_mm + chord, rel=1e-12)
    assert all(-1 <= bulge <= 1 for bulge in ring.bulges)


def test_straight_paths_make_rings_without_bulges() -> None:
    triangle = Path.begin((0, 0)).line_to((4, 0)).line_to((0, 3))
    ring = Ring.polygon([(0, 0), (4, 0), (0, 3)])
    assert Ring.from_path(triangle) == Ring.from_path(triangle.line_to((0, 0))) == ring
    assert Ring.polygon([(0, 0), (4, 0), (0, 3)]).points() == [(0, 0), (4, 0), (0, 3)]


def test_what_is_no_arc_is_refused() -> None:
    with pytest.raises(ValueError, match="bulge 0"):
        Arc.from_bulge((0, 0), (1, 0), 0)
    with pytest.raises(ValueError, match="full circle"):
        _ = Arc(Point(0, 0), False, 2 * math.pi).bulge
    with pytest.raises(ValueError, match="1 bulges for 3 vertices"):
        Ring(Ring.polygon([(0, 0), (4, 0), (0, 3)]).vertices, (1.0,))
    with pytest.raises(ValueError, match="tolerance_mm is 0"):
        Ring.circle((0, 0), 1).points(0)

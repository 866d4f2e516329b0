"""Curves joined end to end. Where more than two ends meet, nothing is guessed: the chains end there."""

from __future__ import annotations

import math
from collections import defaultdict
from dataclasses import dataclass

from ..arc import Arc
from ..path import Path, Step
from ..point import Point

_End = tuple[int, bool]
"""A curve's number, and whether its end (or its start) is meant."""


@dataclass(frozen=True)
class Chain:
    """Curves that run into each other."""

    path: Path
    closed: bool

    @property
    def gap_mm(self) -> float:
        """From its end to its start."""
        return math.dist(self.path.end, self.path.start)


def join(paths: list[Path], join_mm: float) -> list[Chain]:
    """Chains in the order of their first curves. Takes a grid of cells of ``join_mm``: linear in the curves."""
    closed = [path.start == path.end and bool(path.steps) for path in paths]
    partner = _partners({i: path for i, path in enumerate(paths) if not closed[i]}, join_mm)
    chains: list[Chain] = []
    used: set[int] = set()
    for first, path in enumerate(paths):
        if first in used:
            continue
        used.add(first)
        if closed[first]:
            chains.append(Chain(path, True))
            continue
        forward, loop = _walk((first, True), partner, used)
        backward = [] if loop else _walk((first, False), partner, used)[0]
        ways = [(i, not entered) for i, entered in reversed(backward)] + [(first, False), *forward]
        joined = _concatenated([_reversed(paths[i]) if turned else paths[i] for i, turned in ways], loop)
        chains.append(Chain(joined, loop))
    return chains


def _partners(paths: dict[int, Path], join_mm: float) -> dict[_End, _End]:
    """Ends that have exactly one other end within reach."""
    cell = max(join_mm, 1e-9)
    places: dict[_End, Point] = {}
    grid: defaultdict[tuple[int, int], list[_End]] = defaultdict(list)
    for i, path in paths.items():
        for end, place in (((i, False), path.start), ((i, True), path.end)):
            places[end] = place
            grid[math.floor(place.x_mm / cell), math.floor(place.y_mm / cell)].append(end)
    near: dict[_End, list[_End]] = {}
    for end, place in places.items():
        column, row = math.floor(place.x_mm / cell), math.floor(place.y_mm / cell)
        around = (other for dx in (-1, 0, 1) for dy in (-1, 0, 1) for other in grid.get((column + dx, row + dy), ()))
        near[end] = [other for other in around if other != end and math.dist(place, places[other]) <= join_mm]
    return {end: others[0] for end, others in near.items() if len(others) == 1 and len(near[others[0]]) == 1}


def _walk(end: _End, partner: dict[_End, _End], used: set[int]) -> tuple[list[_End], bool]:
    """Curves after ``end``, each with whether it is entered at its end, and whether the way comes back."""
    ways: list[_End] = []
    first = end[0]
    while end in partner:
        curve, entered_at_end = partner[end]
        if curve == first:
            return ways, True
        used.add(curve)
        ways.append((curve, entered_at_end))
        end = (curve, not entered_at_end)
    return ways, False


def _reversed(path: Path) -> Path:
    steps = []
    for start, step in reversed(path.moves()):
        arc = step.arc and Arc(step.arc.center, not step.arc.clockwise, step.arc.sweep_rad)
        steps.append(Step(start, arc))
    return Path(path.end, tuple(steps))


def _concatenated(paths: list[Path], loop: bool) -> Path:
    """One path; small gaps vanish because each curve begins where the one before it ended."""
    steps = [step for path in paths for step in path.steps]
    if loop and steps:
        steps[-1] = Step(paths[0].start, steps[-1].arc)
    return Path(paths[0].start, tuple(steps))

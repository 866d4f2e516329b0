"""Plans and answers of a live server."""

import math
from datetime import timedelta

import pytest

from traverse import (
    Algorithm,
    Client,
    CornerStyle,
    Effort,
    NoPath,
    Obstacle,
    Path,
    Polygon,
    RapidPlan,
    Ring,
    Scene,
)

PLATE = Scene([Obstacle("plate", Ring.rectangle(0, 0, 60, 40))], clearance_mm=3)


def planned(answer: RapidPlan | NoPath) -> RapidPlan:
    assert isinstance(answer, RapidPlan), answer
    return answer


def test_a_straight_way_is_a_straight_line(client: Client) -> None:
    plan = planned(client.plan_rapid_move(Scene(clearance_mm=1), (0, 0), (3, 4)))
    assert plan.cost_mm == 5
    assert plan.path == Path.begin((0, 0)).line_to((3, 4))


def test_round_a_disc_the_length_is_known(client: Client) -> None:
    scene = Scene([Obstacle("disc", Ring.circle((0, 0), 4))], clearance_mm=1)
    plan = planned(client.plan_rapid_move(scene, (-13, 0), (13, 0)))
    # Twice a tangent from 13 to a circle of 5, and what of the half turn they leave.
    assert plan.cost_mm == pytest.approx(2 * 12 + 5 * (math.pi - 2 * math.acos(5 / 13)), abs=1e-9)
    assert plan.lower_bound_mm == plan.cost_mm
    assert plan.path.length_mm == pytest.approx(plan.cost_mm, abs=1e-9)
    assert plan.bending_obstacle_ids == ("disc",)
    assert all(math.hypot(*point) >= 5 - 0.01 - 1e-9 for point in plan.path.points(tolerance_mm=0.01))
    assert plan.stats.expanded_node_count > 0


def test_the_checker_accepts_a_plan_and_finds_a_collision(client: Client) -> None:
    start, target = (-10, 5), (70, 5)
    plan = planned(client.plan_rapid_move(PLATE, start, target))
    sound = client.check_rapid_move(PLATE, start, target, plan.path)
    assert sound.violations == ()
    assert sound.cost_mm == pytest.approx(plan.cost_mm, abs=1e-9)
    through = client.check_rapid_move(PLATE, start, target, Path.begin(start).line_to(target))
    assert {each.reason for each in through.violations} == {"INSIDE_OBSTACLE"}
    assert through.violations[0].obstacle_id == "plate"
    assert through.smallest_margin_mm is not None and through.smallest_margin_mm < 0


def test_no_path_is_an_answer(client: Client) -> None:
    walls = {"west": (-20, -20, 5, 40), "east": (15, -20, 5, 40), "south": (-20, -20, 40, 5), "north": (-20, 15, 40, 5)}
    scene = Scene([Obstacle(name, Ring.rectangle(*wall)) for name, wall in walls.items()], clearance_mm=1)
    answer = client.plan_rapid_move(scene, (0, 0), (50, 0))
    assert isinstance(answer, NoPath)
    assert set(answer.separating_obstacle_ids) == set(walls)
    assert answer.start == (0, 0) and answer.target == (50, 0)


def test_a_hole_and_a_work_area_arrive(client: Client) -> None:
    frame = Polygon(Ring.rectangle(0, 0, 100, 100), (Ring.rectangle(10, 10, 80, 80),))
    scene = Scene([Obstacle("frame", frame, clearance_mm=2)], clearance_mm=5)
    assert planned(client.plan_rapid_move(scene, (12, 12), (88, 88))).cost_mm == pytest.approx(76 * math.sqrt(2))
    # Above the plate there is no room on the table, so the way leads below it.
    table = Ring.rectangle(-20, -10, 100, 52)
    scene = Scene(PLATE.obstacles, clearance_mm=3, work_area=table, work_area_clearance_mm=0)
    plan = planned(client.plan_rapid_move(scene, (-10, 39), (70, 39)))
    assert min(point.y_mm for point in plan.path.points()) == pytest.approx(-3)


def test_the_published_scan_answers_with_its_candidates(client: Client) -> None:
    scene = Scene(PLATE.obstacles, clearance_mm=3, corner_style=CornerStyle.MITER)
    effort = Effort(Algorithm.SUPPORTING_LINES, time_limit=timedelta(seconds=5))
    plan = planned(client.plan_rapid_move(scene, (-10, 5), (70, 5), effort=effort))
    assert [each.length_mm for each in plan.alternatives] == sorted(each.length_mm for each in plan.alternatives)
    assert len(plan.alternatives) == 2
    assert plan.path == plan.alternatives[0]


def test_an_arc_of_more_than_half_a_circle_arrives_whole(client: Client) -> None:
    # Three quarters of a disc of 10, like a pie; its open quarter is the upper right one.
    pie = Ring.from_path(Path.begin((0, 10)).arc_to((10, 0), center=(0, 0)).line_to((0, 0)).line_to((0, 10)))
    scene = Scene([Obstacle("pie", pie)], clearance_mm=1)
    assert planned(client.plan_rapid_move(scene, (2, 2), (12, 12))).cost_mm == pytest.approx(10 * math.sqrt(2))
    assert planned(client.plan_rapid_move(scene, (-10.8, 4), (-10.8, -4))).path.length_mm > 8


def test_limits_are_told(client: Client) -> None:
    limits = client.limits()
    assert limits.coordinate_mm > 0 and limits.vertex_count > 0
    assert timedelta(0) < limits.default_time_limit <= limits.longest_time_limit

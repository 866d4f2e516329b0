"""Places for tool changes, from a live server."""

import math

import pytest

from traverse import Client, NoPath, Obstacle, RequestRefused, Ring, Scene, ToolChangePlan

PLATE = Scene([Obstacle("plate", Ring.rectangle(0, 0, 60, 40))], clearance_mm=3)


def test_the_mirror_point_is_the_best_place(client: Client) -> None:
    empty = Scene(clearance_mm=1)
    answer = client.place_tool_change(empty, (0, 3), (8, 3), regions=[Ring.rectangle(-50, -20, 100, 20)])
    assert isinstance(answer, ToolChangePlan)
    assert answer.place.x_mm == pytest.approx(4, abs=1e-6) and answer.place.y_mm == 0
    assert answer.cost_mm == answer.lower_bound_mm == pytest.approx(10)
    assert answer.approach.target == answer.departure.start == answer.place


def test_both_moves_are_sound_and_points_count(client: Client) -> None:
    start, target = (-10, 5), (70, 5)
    far, near, inside = (200, 200), (30, -3), (30, 20)
    answer = client.place_tool_change(PLATE, start, target, points=[far, near, inside])
    assert isinstance(answer, ToolChangePlan)
    assert answer.place == near
    for begin, end, move in [(start, near, answer.approach), (near, target, answer.departure)]:
        assert client.check_rapid_move(PLATE, begin, end, move.path).violations == ()
    assert answer.cost_mm == pytest.approx(2 * math.hypot(7, 8) + 66, abs=2)
    assert answer.approach.cost_mm + answer.departure.cost_mm == pytest.approx(answer.cost_mm, abs=1e-9)


def test_no_place_is_an_answer_and_none_given_a_fault(client: Client) -> None:
    covered = client.place_tool_change(PLATE, (-10, 5), (70, 5), points=[(30, 20)])
    assert isinstance(covered, NoPath)
    assert covered.separating_obstacle_ids == ("plate",)
    with pytest.raises(RequestRefused) as refused:
        client.place_tool_change(PLATE, (-10, 5), (70, 5))
    assert [finding.field for finding in refused.value.findings] == ["regions"]

"""What a live server refuses."""

import math
from datetime import timedelta

import grpc
import pytest

from traverse import Client, Effort, Obstacle, Point, RequestRefused, Ring, Scene, ServerBusy, TimeOver

PLATE = Scene([Obstacle("plate", Ring.rectangle(0, 0, 60, 40))], clearance_mm=3)


def test_every_finding_arrives(client: Client) -> None:
    crossed = Ring.polygon([(0, 0), (10, 10), (10, 0), (0, 12)])
    scene = Scene([Obstacle("a", crossed), Obstacle("a", Ring.polygon([(0, 0), (1, 1)]))], clearance_mm=-1)
    with pytest.raises(RequestRefused) as refused:
        client.plan_rapid_move(scene, (math.nan, 0), (0, 0))
    error = refused.value
    assert (error.code, error.reason) == (grpc.StatusCode.INVALID_ARGUMENT, "INVALID_REQUEST")
    reasons = {finding.field: finding.reason for finding in error.findings}
    assert reasons["start.x_mm"] == "NOT_FINITE"
    assert reasons["scene.clearance_mm"] == "OUT_OF_RANGE"
    assert set(reasons.values()) >= {"DUPLICATE_ID", "EDGES_CROSS", "TOO_FEW_VERTICES"}
    assert all(finding.field in str(error) and finding.description in str(error) for finding in error.findings)


@pytest.mark.parametrize("ends", [((-3, -3), (5, 5)), ((5, 5), (6, 6))])
def test_ends_inside_a_barrier_are_refused(
    client: Client, ends: tuple[tuple[float, float], tuple[float, float]]
) -> None:
    for call in (client.plan_rapid_move, client.validate_rapid_move):
        with pytest.raises(RequestRefused) as refused:
            call(PLATE, *ends)
        assert refused.value.reason == "END_INSIDE_BARRIER"
        assert refused.value.metadata["obstacle_id"] == "plate"
        assert float(refused.value.metadata["depth_mm"]) > 0
        inside = {"start", "target"} if ends[0] == (5, 5) else {"target"}
        assert {finding.field for finding in refused.value.findings} == inside


def test_a_sound_request_is_valid(client: Client) -> None:
    client.validate_rapid_move(PLATE, (-10, 0), (70, 0))


def test_no_time_is_time_over(client: Client) -> None:
    with pytest.raises(TimeOver) as over:
        client.plan_rapid_move(PLATE, (-10, 5), (70, 5), effort=Effort(time_limit=timedelta(0)))
    assert over.value.reason == "TIME_LIMIT_REACHED"


def test_an_iteration_limit_is_used_up(client: Client) -> None:
    discs = [Obstacle(f"{x},{y}", Ring.circle((x, y), 3)) for x in range(0, 100, 10) for y in range(0, 100, 10)]
    with pytest.raises(ServerBusy) as used_up:
        client.plan_rapid_move(Scene(discs, clearance_mm=1), (-9, -9), (99, 99), effort=Effort(iteration_limit=1))
    assert used_up.value.reason == "ITERATION_LIMIT_REACHED"
    assert used_up.value.retry_after is None


@pytest.mark.parametrize("address", ["ftp://localhost:1", "unix:///x"])
def test_an_address_of_another_kind_is_no_address(address: str) -> None:
    with pytest.raises(ValueError, match="address is"):
        Client(address)


def test_a_deadline_has_to_be_above_zero() -> None:
    with pytest.raises(ValueError, match="deadline is 0"):
        Client("localhost:1", deadline=0)


def test_points_may_be_pairs(client: Client) -> None:
    by_points = client.plan_rapid_move(PLATE, Point(-10, 5), Point(70, 5))
    by_pairs = client.plan_rapid_move(PLATE, (-10, 5), (70, 5))
    assert vars(by_points) | {"stats": None} == vars(by_pairs) | {"stats": None}

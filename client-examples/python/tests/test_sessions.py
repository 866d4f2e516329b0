"""Sessions and distances of a live server."""

import math

import pytest

from traverse import CallFailed, Client, NoPath, Obstacle, RapidPlan, RequestRefused, Ring, Scene

PLATE = Scene([Obstacle("plate", Ring.rectangle(0, 0, 60, 40))], clearance_mm=3)
START, TARGET = (-10, 5), (70, 5)


def cost(answer: RapidPlan | NoPath) -> float:
    assert isinstance(answer, RapidPlan), answer
    return answer.cost_mm


def test_a_session_answers_what_single_calls_answer(client: Client) -> None:
    with client.session(PLATE) as session:
        assert cost(session.plan_rapid_move(START, TARGET)) == cost(client.plan_rapid_move(PLATE, START, TARGET))
        scene = session.edit(put=[Obstacle("boss", Ring.circle((30, -20), 10))])
        assert [obstacle.id for obstacle in scene.obstacles] == ["plate", "boss"]
        found = session.plan_rapid_move(START, TARGET)
        assert cost(found) == cost(client.plan_rapid_move(scene, START, TARGET))
        session.edit(remove=["plate", "boss"])
        assert cost(session.plan_rapid_move(START, TARGET)) == 80


def test_many_moves_are_answered_in_order(client: Client) -> None:
    moves = [((0.0, 0.0), (float(i), 0.0)) for i in range(1000)]
    with client.session(Scene(clearance_mm=1)) as session:
        assert [cost(answer) for answer in session.plan_rapid_moves(moves)] == [float(i) for i in range(1000)]


def test_a_refused_step_fails_alone(client: Client) -> None:
    with client.session(PLATE) as session:
        with pytest.raises(RequestRefused) as inside:
            session.plan_rapid_move((5, 5), TARGET)
        assert [(each.field, each.reason) for each in inside.value.findings] == [("query.start", "END_INSIDE_BARRIER")]
        with pytest.raises(RequestRefused) as unknown:
            session.edit(remove=["vise"])
        assert unknown.value.findings[0].reason == "UNKNOWN_ID"
        with pytest.raises(CallFailed) as stale:
            session.plan_rapid_move(START, TARGET)
        assert stale.value.reason == "SCENE_STALE"
        session.edit()
        assert cost(session.plan_rapid_move(START, TARGET)) > 80


def test_distances_are_the_costs_of_moves(client: Client) -> None:
    wall = Scene(
        [Obstacle("wall", Ring.rectangle(40, 0, 20, 100))], clearance_mm=1, work_area=Ring.rectangle(0, 0, 100, 100)
    )
    points = [(10, 50), (20, 50), (90, 50)]
    assert client.plan_distances(wall, points) == [[0, 10, math.inf], [10, 0, math.inf], [math.inf, math.inf, 0]]
    rows = client.plan_distances(PLATE, [START], [TARGET, (0, -10)])
    assert rows == [[cost(client.plan_rapid_move(PLATE, START, end)) for end in (TARGET, (0, -10))]]

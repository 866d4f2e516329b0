"""Sessions: many rapid moves in one scene that changes as the program goes on."""

from __future__ import annotations

import queue
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from types import TracebackType
from typing import Any

import grpc

from . import wire
from .answer import NoPath, RapidPlan
from .effort import Effort
from .point import Point
from .scene import Obstacle, Scene
from .status import exception, refusal
from .v1 import session_pb2

_AHEAD = 256
"""Moves that are sent ahead of their answers."""

_EFFORT = Effort()


class Session:
    """An open session: what the server keeps of the scene ends with it. Use it in a ``with`` statement.

    A refused move raises RequestRefused, TimeOver or another CallFailed, and the session goes on. After a refused edit
    moves raise CallFailed with reason SCENE_STALE until an edit succeeds. Not to be shared by threads.
    """

    def __init__(self, open_call: Callable[[Iterator[session_pb2.PlanRapidMovesRequest]], Any], scene: Scene) -> None:
        """Sends the scene. ``open_call`` begins the call with an iterator of steps."""
        self._steps: queue.SimpleQueue[session_pb2.PlanRapidMovesRequest | None] = queue.SimpleQueue()
        self._scene = scene
        self._call = open_call(iter(self._steps.get, None))
        self._ask(wire.scene_step(scene))

    def __enter__(self) -> Session:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Ends the session."""
        self._steps.put(None)
        self._call.cancel()

    @property
    def scene(self) -> Scene:
        """The scene as the last edit that succeeded left it."""
        return self._scene

    def edit(self, *, put: Iterable[Obstacle] = (), remove: Iterable[str] = ()) -> Scene:
        """Adds obstacles, or replaces those with the same ids, and removes others: all of it or nothing."""
        put, remove = tuple(put), tuple(remove)
        self._ask(wire.edit_step(put, remove))
        gone = {obstacle.id for obstacle in put} | set(remove)
        kept = tuple(obstacle for obstacle in self._scene.obstacles if obstacle.id not in gone)
        self._scene = _with_obstacles(self._scene, kept + put)
        return self._scene

    def plan_rapid_move(
        self, start: tuple[float, float], target: tuple[float, float], *, effort: Effort = _EFFORT
    ) -> RapidPlan | NoPath:
        """The shortest collision-free rapid move in the scene as it is now, or that there is none."""
        self._steps.put(wire.query_step(start, target, effort))
        return self._outcome(start, target)

    def plan_rapid_moves(
        self, moves: Iterable[tuple[tuple[float, float], tuple[float, float]]], *, effort: Effort = _EFFORT
    ) -> Iterator[RapidPlan | NoPath]:
        """The moves' answers in order. Some hundred moves are sent ahead: much faster than one by one."""
        asked: deque[tuple[tuple[float, float], tuple[float, float]]] = deque()
        for start, target in moves:
            self._steps.put(wire.query_step(start, target, effort))
            asked.append((start, target))
            if len(asked) >= _AHEAD:
                yield self._outcome(*asked.popleft())
        while asked:
            yield self._outcome(*asked.popleft())

    def _outcome(self, start: tuple[float, float], target: tuple[float, float]) -> RapidPlan | NoPath:
        return wire.step_outcome(self._scene, Point(*start), Point(*target), self._next())

    def _ask(self, step: session_pb2.PlanRapidMovesRequest) -> session_pb2.PlanRapidMovesResponse:
        self._steps.put(step)
        return self._next()

    def _next(self) -> session_pb2.PlanRapidMovesResponse:
        try:
            answer: session_pb2.PlanRapidMovesResponse = next(self._call)
        except StopIteration:
            raise RuntimeError("the session is over") from None
        except grpc.RpcError as error:
            raise exception(error) from error
        if answer.WhichOneof("outcome") == "problem":
            raise refusal(answer.problem)
        return answer


def _with_obstacles(scene: Scene, obstacles: tuple[Obstacle, ...]) -> Scene:
    """The scene with other obstacles."""
    return Scene(
        obstacles,
        clearance_mm=scene.clearance_mm,
        work_area=scene.work_area,
        work_area_clearance_mm=scene.work_area_clearance_mm,
        corner_style=scene.corner_style,
        miter_limit=scene.miter_limit,
    )

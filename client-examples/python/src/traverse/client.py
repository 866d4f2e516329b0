"""Calls of the service."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from datetime import timedelta
from types import TracebackType
from typing import Any, TypeVar

import grpc
from google.protobuf.message import Message

from . import wire
from .answer import Check, Limits, NoPath, RapidPlan, ToolChangePlan
from .effort import Effort
from .layout import Certificate, Layout, LayoutRules, PlacedSection, Section
from .path import Path
from .retry import Retry
from .ring import Ring
from .scene import Polygon, Scene
from .session import Session
from .status import exception
from .v1 import distances_pb2, rapid_pb2, sections_pb2, service_pb2, session_pb2

_Response = TypeVar("_Response", bound=Message)

_SERVICE = service_pb2.DESCRIPTOR.services_by_name["PlannerService"].full_name

_CHANNEL_OPTIONS = [
    # A server limits what it answers (GetLimits.message_bytes); gRPC's own 4 MiB is less.
    ("grpc.max_receive_message_length", 64 << 20),
    # Retry decides when to try again; the channel must be ready to connect by then.
    ("grpc.enable_retries", 0),
    ("grpc.initial_reconnect_backoff_ms", 100),
    ("grpc.min_reconnect_backoff_ms", 100),
    ("grpc.max_reconnect_backoff_ms", 1000),
]

_EFFORT = Effort()
_RULES = LayoutRules()
_RETRY = Retry()


class Client:
    """A connection to a Traverse server; connects with the first call, and again when the connection broke.

    Safe to use from several threads. Close it, or use it in a ``with`` statement.
    """

    def __init__(self, address: str = "localhost:50051", *, deadline: float = 30.0, retry: Retry = _RETRY) -> None:
        """A client of the server at ``address``: ``host:port``, ``http://host:port``, or ``https://host:port`` for TLS.

        deadline: seconds that a call may take, all tries included; the server stops by itself shortly before.
        """
        scheme, _, host = address.rpartition("://")
        if scheme not in ("", "http", "https"):
            raise ValueError(f"address is {address}: write host:port, http://host:port or https://host:port")
        host = host.rstrip("/")
        if not deadline > 0:
            raise ValueError(f"deadline is {deadline}: it has to be above 0 seconds")
        self._deadline = deadline
        self._retry = retry
        self._channel = (
            grpc.secure_channel(host, grpc.ssl_channel_credentials(), _CHANNEL_OPTIONS)
            if scheme == "https"
            else grpc.insecure_channel(host, _CHANNEL_OPTIONS)
        )

    def __enter__(self) -> Client:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Ends running calls and the connection."""
        self._channel.close()

    def plan_rapid_move(
        self,
        scene: Scene,
        start: tuple[float, float],
        target: tuple[float, float],
        *,
        effort: Effort = _EFFORT,
        deadline: float | None = None,
    ) -> RapidPlan | NoPath:
        """The shortest collision-free rapid move from ``start`` to ``target``, millimetres, or that there is none.

        deadline: seconds, instead of the client's.
        Raises RequestRefused with every finding, TimeOver, ServerBusy, ServerUnavailable, or another CallFailed.
        """
        request = wire.request_message(scene, start, target, effort)
        response = self._call("PlanRapidMove", request, rapid_pb2.PlanRapidMoveResponse, deadline)
        return wire.outcome(scene, start, target, response)

    def validate_rapid_move(
        self,
        scene: Scene,
        start: tuple[float, float],
        target: tuple[float, float],
        *,
        effort: Effort = _EFFORT,
        deadline: float | None = None,
    ) -> None:
        """Only looks for faults in the request, ends inside barriers included: raises RequestRefused with all."""
        request = wire.request_message(scene, start, target, effort, validate_only=True)
        self._call("PlanRapidMove", request, rapid_pb2.PlanRapidMoveResponse, deadline)

    def check_rapid_move(
        self,
        scene: Scene,
        start: tuple[float, float],
        target: tuple[float, float],
        path: Path,
        *,
        tolerance_mm: float | None = None,
        deadline: float | None = None,
    ) -> Check:
        """Checks a path, wherever it came from, by code that shares nothing with the planner.

        tolerance_mm: how far inside a barrier still counts as touching it. None: 1e-6.
        """
        request = rapid_pb2.CheckRapidMoveRequest(
            request=wire.request_message(scene, start, target, _EFFORT),
            path=wire.path_message(path),
            tolerance_mm=tolerance_mm,
        )
        return wire.check(self._call("CheckRapidMove", request, rapid_pb2.CheckRapidMoveResponse, deadline))

    def place_tool_change(
        self,
        scene: Scene,
        start: tuple[float, float],
        target: tuple[float, float],
        *,
        regions: Iterable[Ring | Polygon] = (),
        points: Iterable[tuple[float, float]] = (),
        effort: Effort = _EFFORT,
        deadline: float | None = None,
    ) -> ToolChangePlan | NoPath:
        """Where to change the tool on the way from ``start`` to ``target``, or that no such place can be reached.

        regions: the change may happen anywhere in one of these; points: or at one of these. One of both is needed. What
        lies in a barrier is left out.
        Raises what ``plan_rapid_move`` raises.
        """
        request = wire.tool_change_message(scene, start, target, regions, points, effort)
        response = self._call("PlaceToolChange", request, rapid_pb2.PlaceToolChangeResponse, deadline)
        return wire.tool_change(scene, start, target, response)

    def plan_distances(
        self,
        scene: Scene,
        sources: Sequence[tuple[float, float]],
        targets: Sequence[tuple[float, float]] = (),
        *,
        effort: Effort = _EFFORT,
        deadline: float | None = None,
    ) -> list[list[float]]:
        """Costs of the shortest moves from each of ``sources`` to each of ``targets``, millimetres.

        A row for each source, ``math.inf`` where there is no way. No targets: from each source to all of them.
        """
        request = wire.distances_message(scene, sources, targets, effort)
        response = self._call("PlanDistances", request, distances_pb2.PlanDistancesResponse, deadline)
        costs, columns = list(response.costs), len(targets) or len(sources)
        return [costs[first : first + columns] for first in range(0, len(costs), columns)]

    def session(self, scene: Scene, *, deadline: float | None = None) -> Session:
        """Opens a session over a scene that changes: for a program's many moves much faster than single calls.

        deadline: seconds that all of it may take. None: as long as steps come; an idle session ends after minutes.
        """
        remote: Any = self._channel.stream_stream(
            f"/{_SERVICE}/PlanRapidMoves",
            session_pb2.PlanRapidMovesRequest.SerializeToString,
            session_pb2.PlanRapidMovesResponse.FromString,
        )
        return Session(lambda steps: remote(steps, timeout=deadline), scene)

    def order_sections(
        self,
        sections: Iterable[Section],
        rules: LayoutRules = _RULES,
        *,
        time_limit: timedelta | None = None,
        deadline: float | None = None,
    ) -> Layout:
        """The order, and of each section the pose, in which a cutting layout is shortest.

        time_limit: the best layout until then is the answer. None: shortly before the deadline.
        deadline: seconds, instead of the client's.
        Raises RequestRefused with every finding, ServerBusy, ServerUnavailable, or another CallFailed.
        """
        request = wire.order_message(sections, rules, time_limit)
        return wire.layout(self._call("OrderSections", request, sections_pb2.OrderSectionsResponse, deadline))

    def check_sections(
        self,
        sections: Iterable[Section],
        rules: LayoutRules,
        order: Iterable[PlacedSection],
        *,
        tolerance_mm: float | None = None,
        certificate: Certificate | None = None,
        deadline: float | None = None,
    ) -> Check:
        """Checks a layout, wherever it came from, by code that shares nothing with the solver.

        tolerance_mm: how much nearer than the gap parts of different sections may come. None: 1e-6.
        certificate: of a layout's bound, to be recomputed as well.
        """
        asked = wire.order_message(sections, rules, None)
        request = wire.check_layout_message(asked, order, tolerance_mm, certificate)
        return wire.layout_check(self._call("CheckSections", request, sections_pb2.CheckSectionsResponse, deadline))

    def limits(self, *, deadline: float | None = None) -> Limits:
        """Largest sizes, longest times and version of the server."""
        return wire.limits(
            self._call("GetLimits", service_pb2.GetLimitsRequest(), service_pb2.GetLimitsResponse, deadline)
        )

    def _call(self, method: str, request: Message, response: type[_Response], deadline: float | None) -> _Response:
        remote: Any = self._channel.unary_unary(
            f"/{_SERVICE}/{method}", type(request).SerializeToString, response.FromString
        )

        def once(seconds: float) -> _Response:
            answer: _Response = remote(request, timeout=seconds)
            return answer

        try:
            return self._retry.run(once, self._deadline if deadline is None else deadline)
        except grpc.RpcError as error:
            raise exception(error) from error

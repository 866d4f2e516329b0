"""Client of Traverse, the service that plans shortest collision-free rapid moves for cutting machines.

>>> from traverse import Client, Obstacle, RapidPlan, Ring, Scene
>>> scene = Scene([Obstacle("plate", Ring.rectangle(0, 0, 60, 40))], clearance_mm=3)
>>> with Client("localhost:50051", deadline=5) as client:  # doctest: +SKIP
...     answer = client.plan_rapid_move(scene, (-10, 5), (95, 30))

Lengths are millimetres, angles radians, times seconds; x to the right, y up, counter-clockwise positive.
"""

from .answer import Check, Limits, NoPath, RapidPlan, Stats, ToolChangePlan, Violation
from .arc import Arc
from .client import Client
from .effort import Algorithm, Effort
from .error import CallFailed, Finding, RequestRefused, ServerBusy, ServerUnavailable, TimeOver
from .layout import Certificate, Layout, LayoutRules, PlacedSection, Pose, Section
from .path import Path, Step
from .picture import picture
from .point import Point
from .retry import Retry
from .ring import Ring
from .scene import CornerStyle, Obstacle, Polygon, Scene
from .session import Session

__all__ = [
    "Algorithm",
    "Arc",
    "CallFailed",
    "Certificate",
    "Check",
    "Client",
    "CornerStyle",
    "Effort",
    "Finding",
    "Layout",
    "LayoutRules",
    "Limits",
    "NoPath",
    "Obstacle",
    "Path",
    "PlacedSection",
    "Point",
    "Polygon",
    "Pose",
    "RapidPlan",
    "RequestRefused",
    "Retry",
    "Ring",
    "Scene",
    "Section",
    "ServerBusy",
    "ServerUnavailable",
    "Session",
    "Stats",
    "Step",
    "TimeOver",
    "ToolChangePlan",
    "Violation",
    "picture",
]

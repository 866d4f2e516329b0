"""Circular edges: a bulge in DXF and in the service's rings, centre and sweep in G2, G3 and in plans."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .point import Point

_FULL_TURN = 2 * math.pi


@dataclass(frozen=True)
class Arc:
    """The circle that an edge follows. Where it starts and ends is said by whoever holds it."""

    center: Point
    clockwise: bool
    """Seen from above. False: counter-clockwise."""
    sweep_rad: float
    """In (0, 2π]; at 2π the end equals the start."""

    @staticmethod
    def from_bulge(start: tuple[float, float], end: tuple[float, float], bulge: float) -> Arc:
        """The arc from ``start`` to ``end`` whose ``bulge`` is tan(sweep / 4), positive counter-clockwise, not 0."""
        if bulge == 0 or not math.isfinite(bulge):
            raise ValueError(f"bulge {bulge} makes no arc: 0 is a straight edge")
        (x0, y0), (x1, y1) = start, end
        # From the middle of the chord to the centre: chord / 2 * cot(sweep / 2), to the left of the chord.
        left = (1 / bulge - bulge) / 4
        center = Point((x0 + x1) / 2 - (y1 - y0) * left, (y0 + y1) / 2 + (x1 - x0) * left)
        return Arc(center, bulge < 0, 4 * math.atan(abs(bulge)))

    @staticmethod
    def about(
        start: tuple[float, float], end: tuple[float, float], center: tuple[float, float], clockwise: bool
    ) -> Arc:
        """The arc about ``center`` as G2 (clockwise) or G3 says it; equal ends make a full circle."""
        (x, y) = center
        turn = math.atan2(end[1] - y, end[0] - x) - math.atan2(start[1] - y, start[0] - x)
        sweep = (-turn if clockwise else turn) % _FULL_TURN
        if sweep == 0 or (start[0] == end[0] and start[1] == end[1]):
            sweep = _FULL_TURN
        return Arc(Point(x, y), clockwise, sweep)

    @property
    def bulge(self) -> float:
        """tan(sweep / 4), negative clockwise; within [−1, 1] up to half a circle. A full circle has none: split it."""
        if self.sweep_rad >= _FULL_TURN:
            raise ValueError("a full circle has no bulge: split it")
        bulge = math.tan(self.sweep_rad / 4)
        return -bulge if self.clockwise else bulge

    def radius_mm(self, start: tuple[float, float]) -> float:
        """Distance of ``start`` from the centre, millimetres."""
        return math.hypot(start[0] - self.center.x_mm, start[1] - self.center.y_mm)

    def length_mm(self, start: tuple[float, float]) -> float:
        """Along the arc, millimetres."""
        return self.radius_mm(start) * self.sweep_rad

    def at(self, start: tuple[float, float], turned_rad: float) -> Point:
        """Where one is after ``turned_rad`` of the sweep, radians, at least 0."""
        angle = -turned_rad if self.clockwise else turned_rad
        cos, sin = math.cos(angle), math.sin(angle)
        x, y = start[0] - self.center.x_mm, start[1] - self.center.y_mm
        return Point(self.center.x_mm + x * cos - y * sin, self.center.y_mm + x * sin + y * cos)

    def points(self, start: tuple[float, float], end: tuple[float, float], tolerance_mm: float) -> list[Point]:
        """Points on the arc after ``start``, ``end`` included, whose chords leave it by at most ``tolerance_mm``."""
        if not tolerance_mm > 0:
            raise ValueError(f"tolerance_mm is {tolerance_mm}: it has to be above 0")
        radius = self.radius_mm(start)
        # A chord over the angle a leaves the arc by r (1 − cos(a / 2)); a third of a turn keeps a circle a triangle.
        widest = 2 * math.acos(max(1 - tolerance_mm / radius, 0.5)) if radius > 0 else math.pi
        count = max(math.ceil(self.sweep_rad / widest), 1)
        return [self.at(start, self.sweep_rad * i / count) for i in range(1, count)] + [Point(*end)]

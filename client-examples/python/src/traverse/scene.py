"""What the tool must keep away from, and where it may be."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import Enum

from .ring import Ring


@dataclass(frozen=True)
class Polygon:
    """A region: an outer ring, less its holes."""

    outer: Ring
    holes: tuple[Ring, ...] = ()

    @property
    def rings(self) -> tuple[Ring, ...]:
        """The outer ring and the holes."""
        return (self.outer, *self.holes)


@dataclass(frozen=True)
class Obstacle:
    """One thing in the way. A ring does for a shape without holes."""

    id: str
    """Unique in its scene, at most 256 bytes; answers name obstacles by it."""
    shape: Ring | Polygon
    clearance_mm: float | None = None
    """Overrides the scene's clearance for this obstacle. None: the scene's."""

    @property
    def polygon(self) -> Polygon:
        """The shape as a polygon."""
        return self.shape if isinstance(self.shape, Polygon) else Polygon(self.shape)


class CornerStyle(Enum):
    """How the barrier, the obstacle grown by the clearance, turns a convex corner."""

    ROUND = "round"
    """Exact arcs: the true distance."""
    MITER = "miter"
    """Parallel lines that meet, as published in 2008."""


@dataclass(frozen=True, init=False)
class Scene:
    """Obstacles, clearance and work area. Lengths are millimetres, x to the right, y up.

    >>> scene = Scene([Obstacle("plate", Ring.rectangle(0, 0, 60, 40))], clearance_mm=3)
    """

    obstacles: tuple[Obstacle, ...]
    clearance_mm: float
    work_area: Ring | Polygon | None
    work_area_clearance_mm: float | None
    corner_style: CornerStyle
    miter_limit: float | None

    def __init__(
        self,
        obstacles: Iterable[Obstacle] = (),
        *,
        clearance_mm: float,
        work_area: Ring | Polygon | None = None,
        work_area_clearance_mm: float | None = None,
        corner_style: CornerStyle = CornerStyle.ROUND,
        miter_limit: float | None = None,
    ) -> None:
        """A scene.

        clearance_mm: distance that the tool's centre keeps from every obstacle: tool radius plus margin.
        work_area: where the tool may be at all. None: the whole plane.
        work_area_clearance_mm: distance kept from its border. None: ``clearance_mm``; 0: the centre may ride on it.
        miter_limit: for mitred corners, corner's distance over clearance beyond which it is cut. None: 1000.
        """
        fields = {
            "obstacles": tuple(obstacles),
            "clearance_mm": clearance_mm,
            "work_area": work_area,
            "work_area_clearance_mm": work_area_clearance_mm,
            "corner_style": corner_style,
            "miter_limit": miter_limit,
        }
        for name, value in fields.items():
            object.__setattr__(self, name, value)

    @property
    def work_area_polygon(self) -> Polygon | None:
        """The work area as a polygon."""
        return Polygon(self.work_area) if isinstance(self.work_area, Ring) else self.work_area

    def _repr_svg_(self) -> str:
        from .picture import picture

        return picture(self)

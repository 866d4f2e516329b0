"""Closed outlines with straight and circular edges."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

from .arc import Arc
from .path import Path, Step
from .point import Point


@dataclass(frozen=True)
class Ring:
    """A closed chain of edges; the first vertex is not repeated, orientation is free."""

    vertices: tuple[Point, ...]
    bulges: tuple[float, ...] = ()
    """Empty when every edge is straight; otherwise tan(sweep / 4) of the edge that leaves each vertex."""

    def __post_init__(self) -> None:
        if self.bulges and len(self.bulges) != len(self.vertices):
            raise ValueError(f"{len(self.bulges)} bulges for {len(self.vertices)} vertices: one each, 0 where straight")

    @staticmethod
    def polygon(points: Iterable[tuple[float, float]]) -> Ring:
        """Straight edges through ``points``, millimetres."""
        return Ring(tuple(Point(*point) for point in points))

    @staticmethod
    def rectangle(x_mm: float, y_mm: float, width_mm: float, height_mm: float) -> Ring:
        """From its lower left corner."""
        right, top = x_mm + width_mm, y_mm + height_mm
        return Ring.polygon([(x_mm, y_mm), (right, y_mm), (right, top), (x_mm, top)])

    @staticmethod
    def circle(center: tuple[float, float], radius_mm: float) -> Ring:
        """Exact: two half circles, each of bulge 1."""
        x, y = center
        return Ring((Point(x - radius_mm, y), Point(x + radius_mm, y)), (1.0, 1.0))

    @staticmethod
    def from_path(path: Path) -> Ring:
        """The outline that ``path`` runs along; an open end is closed by a straight edge.

        Arcs of more than half a circle are split, since a bulge is within [−1, 1].
        """
        vertices: list[Point] = []
        bulges: list[float] = []
        for start, step in path.moves():
            corners, bulge = _edges(start, step)
            vertices += corners
            bulges += [bulge] * len(corners)
        if path.end != path.start:
            vertices.append(path.end)
            bulges.append(0.0)
        return Ring(tuple(vertices), tuple(bulges) if any(bulges) else ())

    @property
    def outline(self) -> Path:
        """Once round, from the first vertex back to it."""
        count = len(self.vertices)
        steps = []
        for i, start in enumerate(self.vertices):
            end, bulge = self.vertices[(i + 1) % count], self.bulges[i] if self.bulges else 0.0
            steps.append(Step(end, Arc.from_bulge(start, end, bulge) if bulge and end != start else None))
        return Path(self.vertices[0], tuple(steps)) if self.vertices else Path(Point(math.nan, math.nan))

    @property
    def length_mm(self) -> float:
        """Once round, millimetres."""
        return self.outline.length_mm

    def points(self, tolerance_mm: float = 0.01) -> list[Point]:
        """The outline as a polygon, first point not repeated; chords leave arcs by at most ``tolerance_mm``."""
        return self.outline.points(tolerance_mm)[:-1]


def _edges(start: Point, step: Step) -> tuple[list[Point], float]:
    """Where the edges of ``step`` begin, and the bulge that they share."""
    if step.arc is None:
        return [start], 0.0
    if step.arc.sweep_rad <= math.pi:
        return [start], step.arc.bulge
    half = step.arc.sweep_rad / 2
    return [start, step.arc.at(start, half)], Arc(step.arc.center, step.arc.clockwise, half).bulge

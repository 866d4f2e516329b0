"""Directed chains of straight and circular moves."""

from __future__ import annotations

import math
from dataclasses import dataclass

from .arc import Arc
from .point import Point


@dataclass(frozen=True)
class Step:
    """One move, from where the step before it ended."""

    end: Point
    arc: Arc | None = None
    """None: straight."""


@dataclass(frozen=True)
class Path:
    """Moves in order. Paths are values: ``line_to`` and ``arc_to`` make a longer one.

    >>> quarter = Path.begin((10, 0)).arc_to((0, 10), center=(0, 0)).line_to((0, 0))
    >>> round(quarter.length_mm, 3)
    25.708
    """

    start: Point
    steps: tuple[Step, ...] = ()

    @staticmethod
    def begin(start: tuple[float, float]) -> Path:
        """A path without moves."""
        return Path(Point(*start))

    def line_to(self, end: tuple[float, float]) -> Path:
        """This path and a straight move to ``end``."""
        return Path(self.start, (*self.steps, Step(Point(*end))))

    def arc_to(self, end: tuple[float, float], center: tuple[float, float], clockwise: bool = False) -> Path:
        """This path and an arc to ``end``, as G3 or, clockwise, G2 says it; to where it is: a full circle."""
        return Path(self.start, (*self.steps, Step(Point(*end), Arc.about(self.end, end, center, clockwise))))

    @property
    def end(self) -> Point:
        """Where the last step ends."""
        return self.steps[-1].end if self.steps else self.start

    @property
    def length_mm(self) -> float:
        """Sum over the steps, millimetres."""
        return math.fsum(
            step.arc.length_mm(start) if step.arc else math.dist(start, step.end) for start, step in self.moves()
        )

    def moves(self) -> list[tuple[Point, Step]]:
        """Every step with where it starts."""
        starts = [self.start, *(step.end for step in self.steps)]
        return list(zip(starts, self.steps))

    def points(self, tolerance_mm: float = 0.01) -> list[Point]:
        """The path as a polyline: corners, and arcs sampled so that no chord leaves its arc by more."""
        points = [self.start]
        for start, step in self.moves():
            points += step.arc.points(start, step.end, tolerance_mm) if step.arc else [step.end]
        return points

"""Which outline lies inside which: outermost ones are shapes, those directly inside are holes, and so on."""

from __future__ import annotations

from dataclasses import dataclass

from ..point import Point
from ..ring import Ring
from ..scene import Polygon

_TOLERANCE_MM = 0.01
"""Of the polygons that containment is decided on."""


@dataclass(frozen=True)
class _Outline:
    ring: Ring
    points: list[Point]
    area: float
    box: tuple[float, float, float, float]

    @staticmethod
    def of(ring: Ring) -> _Outline:
        points = ring.points(_TOLERANCE_MM)
        twice = sum(a.x_mm * b.y_mm - b.x_mm * a.y_mm for a, b in zip(points, points[1:] + points[:1]))
        xs, ys = [point.x_mm for point in points], [point.y_mm for point in points]
        return _Outline(ring, points, abs(twice) / 2, (min(xs), min(ys), max(xs), max(ys)))

    def holds(self, other: _Outline) -> bool:
        """Whether most corners of ``other`` lie inside, so that a corner on the outline decides nothing."""
        left, bottom, right, top = self.box
        if other.area >= self.area or other.box[0] > right or other.box[2] < left:
            return False
        if other.box[1] > top or other.box[3] < bottom:
            return False
        return 2 * sum(self._contains(point) for point in other.points) > len(other.points)

    def _contains(self, point: Point) -> bool:
        inside = False
        for a, b in zip(self.points, self.points[1:] + self.points[:1]):
            if (a.y_mm > point.y_mm) != (b.y_mm > point.y_mm):
                across = a.x_mm + (point.y_mm - a.y_mm) / (b.y_mm - a.y_mm) * (b.x_mm - a.x_mm)
                inside ^= point.x_mm < across
        return inside


def nested(rings: list[Ring]) -> list[Polygon]:
    """Shapes with their holes, in the order of the outer rings. Compares every pair: for hundreds of them."""
    outlines = [_Outline.of(ring) for ring in rings]
    around = [[i for i, outer in enumerate(outlines) if outer.holds(inner)] for inner in outlines]
    holes: dict[int, list[Ring]] = {i: [] for i, outer in enumerate(around) if len(outer) % 2 == 0}
    for i, outer in enumerate(around):
        if len(outer) % 2 == 1:
            parent = min(outer, key=lambda each: outlines[each].area)
            holes.get(parent, []).append(rings[i])
    return [Polygon(rings[i], tuple(inside)) for i, inside in holes.items()]

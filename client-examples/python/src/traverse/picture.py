"""Scenes and plans as SVG: plain text, nothing to install. Drawn true to scale with y up; arcs stay arcs."""

from __future__ import annotations

import math
from collections.abc import Collection
from html import escape

from .path import Path
from .ring import Ring
from .scene import Polygon, Scene

_WIDTH_PX = 720.0
_TALLEST_PX = 540.0
_MARGIN_PX = 16.0
# Attributes and not a style sheet: that of a picture in a notebook would hold for the whole page.
_LOOKS = {
    "area": 'fill="#fff" stroke="#868e96" stroke-dasharray="6 4"',
    "obstacle": 'fill="#ced4da" stroke="#495057" fill-rule="evenodd"',
    "marked": 'fill="#ffc9c9" stroke="#c92a2a" fill-rule="evenodd"',
    "path": 'fill="none" stroke="#1971c2" stroke-width="2" stroke-linejoin="round"',
    "start": 'fill="#2b8a3e"',
    "target": 'fill="#c92a2a"',
}


def picture(
    scene: Scene,
    *,
    path: Path | None = None,
    start: tuple[float, float] | None = None,
    target: tuple[float, float] | None = None,
    marked: Collection[str] = (),
) -> str:
    """An SVG document of ``scene`` with a path, or with two ends.

    marked: ids of obstacles to show in red.
    """
    if path is not None:
        start, target = path.start, path.end
    ends = [(kind, end) for kind, end in (("start", start), ("target", target)) if end is not None]
    frame = _Frame(_extent(scene, path, [end for _, end in ends]))
    shapes = []
    if scene.work_area_polygon is not None:
        shapes.append(frame.region("area", scene.work_area_polygon, "work area"))
    for obstacle in scene.obstacles:
        shapes.append(frame.region("marked" if obstacle.id in marked else "obstacle", obstacle.polygon, obstacle.id))
    if path is not None:
        shapes.append(_shape("path", f'd="{frame.outline(path)}"', f"{path.length_mm:.3f} mm"))
    for kind, end in ends:
        x, y = frame.px(end)
        shapes.append(_shape(kind, f'cx="{x}" cy="{y}" r="4"', f"{kind} {end[0]:g}, {end[1]:g}", "circle"))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{frame.width:.0f}" height="{frame.height:.0f}" '
        f'viewBox="0 0 {frame.width:.2f} {frame.height:.2f}">{"".join(shapes)}</svg>'
    )


class _Frame:
    """From millimetres, y up, to pixels, y down."""

    def __init__(self, extent: tuple[float, float, float, float]) -> None:
        left, bottom, right, top = extent
        inner = _WIDTH_PX - 2 * _MARGIN_PX
        self._scale = min(inner / max(right - left, 1e-6), (_TALLEST_PX - 2 * _MARGIN_PX) / max(top - bottom, 1e-6))
        self._left, self._top = left, top
        self.width = (right - left) * self._scale + 2 * _MARGIN_PX
        self.height = (top - bottom) * self._scale + 2 * _MARGIN_PX

    def px(self, point: tuple[float, float]) -> tuple[float, float]:
        """Pixels, rounded to what can be seen."""
        x = (point[0] - self._left) * self._scale + _MARGIN_PX
        y = (self._top - point[1]) * self._scale + _MARGIN_PX
        return round(x, 3), round(y, 3)

    def outline(self, path: Path) -> str:
        """The data of an SVG path."""
        data = ["M{} {}".format(*self.px(path.start))]
        for start, step in path.moves():
            if step.arc is None:
                data.append("L{} {}".format(*self.px(step.end)))
                continue
            # SVG draws nothing when an arc's ends are equal, and a half turn's side is a matter of rounding: in two.
            half = step.arc.at(start, step.arc.sweep_rad / 2)
            radius = round(step.arc.radius_mm(start) * self._scale, 3)
            side = 1 if step.arc.clockwise else 0
            for end in (half, step.end):
                data.append("A{0} {0} 0 0 {1} {2} {3}".format(radius, side, *self.px(end)))
        return "".join(data)

    def region(self, kind: str, polygon: Polygon, title: str) -> str:
        """A polygon with its holes."""
        data = "".join(self.outline(ring.outline) + "Z" for ring in polygon.rings if ring.vertices)
        return _shape(kind, f'd="{data}"', title)


def _shape(kind: str, geometry: str, title: str, element: str = "path") -> str:
    """One element; its title shows under the mouse."""
    return f'<{element} class="{kind}" {geometry} {_LOOKS[kind]}><title>{escape(title)}</title></{element}>'


def _extent(scene: Scene, path: Path | None, ends: list[tuple[float, float]]) -> tuple[float, float, float, float]:
    """Left, bottom, right, top of all there is to see."""
    rings: list[Ring] = [obstacle.polygon.outer for obstacle in scene.obstacles]
    if scene.work_area_polygon is not None:
        rings.append(scene.work_area_polygon.outer)
    points = [*ends]
    for outline in [ring.outline for ring in rings if ring.vertices] + ([path] if path else []):
        for start, step in outline.moves():
            points += [start, step.end]
            if step.arc is not None:
                # Sixteenths of the sweep: outside by at most 2 % of the radius, which the margin takes.
                points += [step.arc.at(start, step.arc.sweep_rad * i / 16) for i in range(1, 16)]
    seen = [(x, y) for x, y in points if math.isfinite(x) and math.isfinite(y)] or [(0.0, 0.0)]
    xs, ys = [x for x, _ in seen], [y for _, y in seen]
    return min(xs), min(ys), max(xs), max(ys)

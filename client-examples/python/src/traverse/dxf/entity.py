"""From DXF entities to paths, millimetres. Arcs and bulges stay exact."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from ezdxf.entities.arc import Arc as DxfArc
from ezdxf.entities.circle import Circle
from ezdxf.entities.dxfentity import DXFEntity
from ezdxf.entities.ellipse import Ellipse
from ezdxf.entities.insert import Insert
from ezdxf.entities.line import Line
from ezdxf.entities.lwpolyline import LWPolyline
from ezdxf.entities.polyline import Polyline
from ezdxf.entities.spline import Spline
from ezdxf.math import OCS, Vec3
from ezdxf.path import make_path

from ..arc import Arc
from ..path import Path, Step
from ..point import Point

ANNOTATIONS = frozenset(
    "ARC_DIMENSION ATTDEF ATTRIB DIMENSION LARGE_RADIAL_DIMENSION LEADER LIGHT MLEADER MTEXT MULTILEADER POINT RAY "
    "TEXT TOLERANCE VIEWPORT XLINE".split()
)
"""Nothing that a tool could meet."""

_DEEPEST_BLOCK = 16

_IN_A_PLANE = (Circle, Ellipse, LWPolyline, Polyline, Spline)
"""Arcs are circles here."""


def flat(
    entities: Iterable[DXFEntity], depth: int = 0, layer_of_block: str | None = None
) -> Iterator[tuple[str, DXFEntity]]:
    """Entities with their layers, blocks taken apart; layer 0 inside a block is the layer of its insert."""
    if depth > _DEEPEST_BLOCK:
        raise ValueError(f"blocks are nested more than {_DEEPEST_BLOCK} deep")
    for entity in entities:
        layer = entity.dxf.get("layer", "0")
        layer = layer_of_block if layer == "0" and layer_of_block is not None else layer
        if isinstance(entity, Insert) and _is_in_file(entity):
            for insert in entity.multi_insert() if entity.mcount > 1 else [entity]:
                yield from flat(_parts(insert), depth + 1, layer)
        else:
            yield layer, entity


def _is_in_file(insert: Insert) -> bool:
    """Whether the file holds its block: it may be missing, or lie in another file."""
    layout = insert.block()
    return layout is not None and layout.block is not None and not layout.block.is_xref


def _parts(insert: Insert) -> Iterator[DXFEntity]:
    """What the block holds, moved to its place; what can't be moved as it is, to be counted."""
    skipped: list[DXFEntity] = []
    yield from insert.virtual_entities(skipped_entity_callback=lambda part, _: skipped.append(part))
    yield from skipped


def path_of(entity: DXFEntity, scale: float, tolerance_mm: float) -> Path | None:
    """The path along ``entity``; None when it is no curve in the plane. ``scale``: millimetres in a unit."""
    if isinstance(entity, Line):
        # Lines are in world coordinates, whatever their extrusion says.
        return Path.begin(_scaled(entity.dxf.start, scale)).line_to(_scaled(entity.dxf.end, scale))
    # Other types have no extrusion to be asked for.
    plane = _Plane.of(entity, scale) if isinstance(entity, _IN_A_PLANE) else None
    if plane is None:
        return None
    if isinstance(entity, DxfArc):  # before Circle, which it is a kind of
        sweep = math.radians(entity.dxf.end_angle - entity.dxf.start_angle) % (2 * math.pi) or 2 * math.pi
        return plane.arc(entity.start_point, entity.end_point, entity.dxf.center, sweep)
    if isinstance(entity, Circle):
        rim = entity.dxf.center + Vec3(abs(entity.dxf.radius), 0)
        start = plane.ocs.to_wcs(rim)
        return plane.arc(start, start, entity.dxf.center, 2 * math.pi)
    if isinstance(entity, LWPolyline):
        corners = [(Vec3(x, y), bulge) for x, y, bulge in entity.get_points("xyb")]
        return plane.polyline(corners, entity.closed)
    if isinstance(entity, Polyline) and entity.is_2d_polyline:
        corners = [(v.dxf.location, v.dxf.get("bulge", 0.0)) for v in entity.vertices if not v.dxf.flags & 16]
        return plane.polyline(corners, entity.is_closed)
    if isinstance(entity, (Ellipse, Spline)):
        points = [_scaled(point, scale) for point in make_path(entity).flattening(tolerance_mm / scale)]
        return Path(points[0], tuple(Step(point) for point in points[1:])) if points else None
    return None


class _Plane:
    """The coordinates that an entity is drawn in: seen from above, or mirrored (extrusion −Z)."""

    def __init__(self, ocs: OCS, mirrored: bool, scale: float) -> None:
        self.ocs, self.mirrored, self.scale = ocs, mirrored, scale

    @staticmethod
    def of(entity: DXFEntity, scale: float) -> _Plane | None:
        """None: drawn in another plane."""
        extrusion = Vec3(entity.dxf.get("extrusion", (0, 0, 1))).normalize()
        if math.hypot(extrusion.x, extrusion.y) > 1e-9:
            return None
        return _Plane(OCS(extrusion), extrusion.z < 0, scale)

    def arc(self, start: Vec3, end: Vec3, center: Vec3, sweep: float) -> Path:
        """Ends in world coordinates, the centre in the entity's."""
        arc = Arc(_scaled(self.ocs.to_wcs(Vec3(center)), self.scale), self.mirrored, sweep)
        return Path(_scaled(start, self.scale), (Step(_scaled(end, self.scale), arc),))

    def polyline(self, corners: list[tuple[Vec3, float]], closed: bool) -> Path | None:
        """Corners in the entity's coordinates, each with the bulge of the edge that leaves it."""
        if not corners:
            return None
        points = [_scaled(self.ocs.to_wcs(corner), self.scale) for corner, _ in corners]
        ends = points[1:] + (points[:1] if closed else [])
        steps = []
        for start, end, (_, bulge) in zip(points, ends, corners):
            if start != end:
                turned = -bulge if self.mirrored else bulge
                steps.append(Step(end, Arc.from_bulge(start, end, turned) if turned else None))
        return Path(points[0], tuple(steps))


def _scaled(point: Vec3, scale: float) -> Point:
    return Point(point.x * scale, point.y * scale)

"""What of an entity its path does not show: the width of a band, and heights."""

from __future__ import annotations

from ezdxf.entities.dxfentity import DXFEntity
from ezdxf.entities.line import Line
from ezdxf.entities.lwpolyline import LWPolyline
from ezdxf.entities.polyline import Polyline
from ezdxf.entities.spline import Spline

_HEIGHT_TOLERANCE = 1e-9
"""Heights that differ by less, in the file's unit, differ by rounding."""


def is_band(entity: DXFEntity) -> bool:
    """Whether it is drawn with a width: its path is the centre line, and a tool could meet the rest."""
    if isinstance(entity, LWPolyline):
        own = [width for point in entity.get_points("se") for width in point]
        return any([entity.dxf.get("const_width", 0.0), *own])
    if isinstance(entity, Polyline) and entity.is_2d_polyline:
        common = [entity.dxf.get(f"default_{end}_width", 0.0) for end in ("start", "end")]
        own = [vertex.dxf.get(f"{end}_width", 0.0) for vertex in entity.vertices for end in ("start", "end")]
        return any(common + own)
    return False


def is_flattened(entity: DXFEntity) -> bool:
    """Whether it climbs: its path is what is seen from above."""
    if isinstance(entity, Line):
        heights = [entity.dxf.start.z, entity.dxf.end.z]
    elif isinstance(entity, Polyline):
        heights = [vertex.dxf.location.z for vertex in entity.vertices]
    elif isinstance(entity, Spline):
        heights = [point[2] for points in (entity.control_points, entity.fit_points) for point in points]
    else:
        return False
    return bool(heights) and max(heights) - min(heights) > _HEIGHT_TOLERANCE

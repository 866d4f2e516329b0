"""From a DXF file to a scene, with everything that was not used said."""

from __future__ import annotations

import os
from collections import Counter, defaultdict
from dataclasses import dataclass

import ezdxf.filemanagement
from ezdxf.document import Drawing

from ..path import Path
from ..ring import Ring
from ..scene import Obstacle, Polygon, Scene
from .chain import Chain, join
from .entity import ANNOTATIONS, flat, path_of
from .nesting import nested

WORK_AREA_LAYERS = frozenset({"WORK_AREA", "WORKAREA", "TABLE"})

_MILLIMETRES = {
    0: 1.0, 1: 25.4, 2: 304.8, 4: 1.0, 5: 10.0, 6: 1000.0, 8: 25.4e-6, 9: 0.0254, 10: 914.4, 13: 0.001, 14: 100.0
}  # fmt: skip
"""In one unit, by $INSUNITS; 0 names none and is taken as millimetres."""


@dataclass(frozen=True)
class SceneFromDxf:
    """A scene, and what of the drawing is not in it."""

    scene: Scene
    unused: tuple[str, ...]
    """For people: what a tool could meet and is not in the scene, such as open chains. Empty: all was used."""
    annotations: tuple[str, ...]
    """For people: texts, dimensions and the like, counted."""


def read_scene(
    file: str | os.PathLike[str],
    *,
    clearance_mm: float,
    work_area_clearance_mm: float | None = None,
    join_mm: float = 0.01,
    tolerance_mm: float = 0.001,
) -> SceneFromDxf:
    """Reads a scene: the layers WORK_AREA, WORKAREA or TABLE bound the work area, all others hold obstacles.

    Outermost outlines of a layer are obstacles ``LAYER/1``, ``LAYER/2``, …, in the order in which they were drawn;
    outlines directly inside are their holes.

    join_mm: ends of lines that are no farther apart are joined.
    tolerance_mm: how far chords may leave splines and ellipses, to either side; circles and arcs stay exact.
    Raises ValueError when the work area is not one outline or the unit is no length, ezdxf.DXFError and OSError when
    the file can't be read.
    """
    document = ezdxf.filemanagement.readfile(file)
    layers, unused, annotations = _layers(document, tolerance_mm)
    areas: list[Polygon] = []
    obstacles: list[Obstacle] = []
    for layer, paths in layers.items():
        chains = join(paths, join_mm)
        unused += [f"layer {layer}: {_gap(chain)}" for chain in chains if not chain.closed]
        shapes = nested([Ring.from_path(chain.path) for chain in chains if chain.closed])
        if layer.upper() in WORK_AREA_LAYERS:
            areas += shapes
        else:
            obstacles += [Obstacle(f"{layer}/{number}", shape) for number, shape in enumerate(shapes, 1)]
    if len(areas) > 1:
        raise ValueError(f"{file}: the work area's layers hold {len(areas)} outlines apart; one can bound it")
    if not areas and any(layer.upper() in WORK_AREA_LAYERS for layer in layers):
        raise ValueError(f"{file}: the work area is not closed: {'; '.join(unused)}")
    scene = Scene(
        obstacles,
        clearance_mm=clearance_mm,
        work_area=areas[0] if areas else None,
        work_area_clearance_mm=work_area_clearance_mm,
    )
    return SceneFromDxf(scene, tuple(unused), tuple(annotations))


def _layers(document: Drawing, tolerance_mm: float) -> tuple[dict[str, list[Path]], list[str], list[str]]:
    """Curves by layer in the order in which they were drawn, what is no curve, and annotations."""
    unit = int(document.units)
    if unit not in _MILLIMETRES:
        raise ValueError(f"$INSUNITS is {unit}: no length that a machine works in")
    layers: defaultdict[str, list[Path]] = defaultdict(list)
    dropped: Counter[str] = Counter()
    annotations: Counter[str] = Counter()
    for layer, entity in flat(document.modelspace()):
        path = path_of(entity, _MILLIMETRES[unit], tolerance_mm)
        if path is not None:
            layers[layer].append(path)
        else:
            what = annotations if entity.dxftype() in ANNOTATIONS else dropped
            what[f"layer {layer}: {entity.dxftype()}"] += 1
    return dict(layers), _counted(dropped), _counted(annotations)


def _counted(what: Counter[str]) -> list[str]:
    return [f"{name}, {count} not read" for name, count in sorted(what.items())]


def _gap(chain: Chain) -> str:
    (x0, y0), (x1, y1) = chain.path.start, chain.path.end
    return f"open chain from {x0:.3f}, {y0:.3f} to {x1:.3f}, {y1:.3f}, gap {chain.gap_mm:.3f} mm"

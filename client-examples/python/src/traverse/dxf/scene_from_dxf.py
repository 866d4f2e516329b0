"""From a DXF file to a scene, with everything that was not used said."""

from __future__ import annotations

import os
import re
from collections import Counter, defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path as File
from typing import Literal

import ezdxf.filemanagement
from ezdxf.document import Drawing
from ezdxf.entities.dxfentity import DXFEntity

from ..path import Path
from ..ring import Ring
from ..scene import Obstacle, Polygon, Scene
from .chain import Chain, join
from .entity import ANNOTATIONS, flat, path_of
from .nesting import nested
from .simplified import is_band, is_flattened

WORK_AREA_LAYERS = frozenset({"WORK_AREA", "WORKAREA", "TABLE"})

_MILLIMETRES = {
    1: 25.4, 2: 304.8, 4: 1.0, 5: 10.0, 6: 1000.0, 8: 25.4e-6, 9: 0.0254, 10: 914.4, 13: 0.001, 14: 100.0
}  # fmt: skip
"""In one unit, by $INSUNITS; 0 names none."""

Unit = Literal["mm", "inch"]

_BY_NAME: dict[Unit, float] = {"mm": 1.0, "inch": 25.4}

_NAMES_UNIT = re.compile(rb"(?:^|[\r\n])[ \t]*9[ \t]*\r?\n[ \t]*\$INSUNITS[ \t]*\r?\n|\x09\x00?\$INSUNITS\x00")
"""Group 9, only found in headers, as text or binary. ezdxf fills in what a file without header does not say: metres."""


@dataclass(frozen=True)
class SceneFromDxf:
    """A scene, and what of the drawing is not in it."""

    scene: Scene
    unused: tuple[str, ...]
    """For people: what a tool could meet and is not in the scene, such as open chains. Empty: all was used."""
    annotations: tuple[str, ...]
    """For people: texts, dimensions and the like, and what climbs and is taken as seen from above, counted."""
    millimetres: float
    """In one unit of the file."""
    unit_assumed: bool
    """Whether the file names no unit, so that ``unit`` was taken."""


def read_scene(
    file: str | os.PathLike[str],
    *,
    clearance_mm: float,
    work_area_clearance_mm: float | None = None,
    join_mm: float = 0.01,
    tolerance_mm: float = 0.001,
    unit: Unit = "mm",
) -> SceneFromDxf:
    """Reads a scene: the layers WORK_AREA, WORKAREA or TABLE bound the work area, all others hold obstacles.

    Outermost outlines of a layer are obstacles ``LAYER/1``, ``LAYER/2``, …, in the order in which they were drawn;
    outlines directly inside are their holes.

    join_mm: ends of lines that are no farther apart are joined.
    tolerance_mm: how far chords may leave splines and ellipses, to either side; circles and arcs stay exact.
    unit: of a file that names none.
    Raises ValueError when the work area is not one outline or the unit is no length, ezdxf.DXFError and OSError when
    the file can't be read.
    """
    document = ezdxf.filemanagement.readfile(file)
    stated = _stated_millimetres(document, file)
    millimetres = stated or _BY_NAME[unit]
    layers, unused, annotations = _layers(flat(document.modelspace()), millimetres, tolerance_mm)
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
    return SceneFromDxf(scene, tuple(unused), tuple(annotations), millimetres, stated is None)


def _stated_millimetres(document: Drawing, file: str | os.PathLike[str]) -> float | None:
    """In one unit, as the file itself says; None when it names no unit."""
    unit = int(document.units)
    if unit == 0 or not _NAMES_UNIT.search(File(file).read_bytes()):
        return None
    if unit not in _MILLIMETRES:
        raise ValueError(f"$INSUNITS is {unit}: no length that a machine works in")
    return _MILLIMETRES[unit]


def _layers(
    entities: Iterable[tuple[str, DXFEntity]], millimetres: float, tolerance_mm: float
) -> tuple[dict[str, list[Path]], list[str], list[str]]:
    """Curves by layer in the order in which they were drawn, what a tool could meet beside them, and what it can't."""
    layers: defaultdict[str, list[Path]] = defaultdict(list)
    dropped: Counter[str] = Counter()
    annotations: Counter[str] = Counter()
    for layer, entity in entities:
        name = f"layer {layer}: {entity.dxftype()}"
        path = path_of(entity, millimetres, tolerance_mm)
        if path is None:
            what = annotations if entity.dxftype() in ANNOTATIONS else dropped
            what[f"{name}, {{}} not read"] += 1
            continue
        layers[layer].append(path)
        if is_band(entity):
            dropped[f"{name}, {{}} with a width: only the centre line is read; draw the band's outline"] += 1
        if is_flattened(entity):
            annotations[f"{name}, {{}} at varying height: taken as seen from above"] += 1
    return dict(layers), _counted(dropped), _counted(annotations)


def _counted(what: Counter[str]) -> list[str]:
    # Layers are named by others: their braces are no places for the count.
    return [str(count).join(words.rsplit("{}", 1)) for words, count in sorted(what.items())]


def _gap(chain: Chain) -> str:
    (x0, y0), (x1, y1) = chain.path.start, chain.path.end
    return f"open chain from {x0:.3f}, {y0:.3f} to {x1:.3f}, {y1:.3f}, gap {chain.gap_mm:.3f} mm"

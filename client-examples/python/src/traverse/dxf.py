"""Scenes from DXF drawings, by ezdxf: ``pip install 'traverse-client[dxf]'``.

Layers WORK_AREA, WORKAREA or TABLE bound the work area; outlines on all other layers are obstacles, named ``LAYER/1``,
``LAYER/2``, … Nothing is guessed: what can't be used is reported.
"""

from __future__ import annotations

import math
import os
from collections import Counter, defaultdict
from collections.abc import Iterable
from dataclasses import dataclass

import ezdxf
from ezdxf import units
from ezdxf.disassemble import recursive_decompose
from ezdxf.document import Drawing

from ._chains import Loops, join
from ._entities import path_of
from ._nesting import polygons
from .path import Path
from .scene import Obstacle, Polygon, Scene

WORK_AREA_LAYERS = frozenset({"WORK_AREA", "WORKAREA", "TABLE"})


@dataclass(frozen=True)
class SceneFromDxf:
    """A scene, and what of the drawing is not in it."""

    scene: Scene
    unused: tuple[str, ...]
    """For people, such as ``layer CLAMPS: open chain, 3.2 mm from end to end at 10, 20``. Empty: all was used."""


def read_scene(
    file: str | os.PathLike[str],
    *,
    clearance_mm: float,
    work_area_clearance_mm: float | None = None,
    join_mm: float = 0.01,
    tolerance_mm: float = 0.001,
) -> SceneFromDxf:
    """Reads a scene.

    join_mm: ends of lines that are no farther apart are joined.
    tolerance_mm: how far the chords of splines and ellipses may leave them; circles and arcs stay exact.
    Raises ValueError when the work area is not one outline, ezdxf.DXFError and OSError when the file can't be read.
    """
    document = ezdxf.readfile(file)  # type: ignore[attr-defined]
    found, unused = _loops(document, join_mm, tolerance_mm)
    areas = [shape for layer in sorted(found) if layer.upper() in WORK_AREA_LAYERS for shape in polygons(found[layer])]
    if len(areas) > 1:
        raise ValueError(f"the work area's layers hold {len(areas)} outlines; one can bound it")
    obstacles = [
        Obstacle(f"{layer}/{number}", shape)
        for layer in sorted(found)
        if layer.upper() not in WORK_AREA_LAYERS
        for number, shape in enumerate(polygons(found[layer]), 1)
    ]
    area: Polygon | None = areas[0] if areas else None
    scene = Scene(
        obstacles, clearance_mm=clearance_mm, work_area=area, work_area_clearance_mm=work_area_clearance_mm
    )
    return SceneFromDxf(scene, tuple(unused))


def _loops(document: Drawing, join_mm: float, tolerance_mm: float) -> tuple[dict[str, Loops], list[str]]:
    """Closed outlines by layer, and what is none."""
    scale = _millimetres(document)
    paths: defaultdict[str, list[Path]] = defaultdict(list)
    dropped: Counter[tuple[str, str]] = Counter()
    for entity in recursive_decompose(document.modelspace()):
        path = path_of(entity, scale, tolerance_mm)
        if path is not None:
            paths[entity.dxf.layer].append(path)
        elif entity.dxftype() not in _SILENT:
            dropped[entity.dxf.layer, entity.dxftype()] += 1
    unused = [f"layer {layer}: {count} {kind}" for (layer, kind), count in sorted(dropped.items())]
    loops = {}
    for layer, drawn in paths.items():
        loops[layer] = join(drawn, join_mm)
        unused += [f"layer {layer}: {_open(chain)}" for chain in loops[layer].open]
    return loops, unused

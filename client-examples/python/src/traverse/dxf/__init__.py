"""Scenes from DXF drawings, by ezdxf: ``pip install '…[dxf]'``."""

from .scene_from_dxf import WORK_AREA_LAYERS, SceneFromDxf, Unit, read_scene

__all__ = ["WORK_AREA_LAYERS", "SceneFromDxf", "Unit", "read_scene"]

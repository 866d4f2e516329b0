"""A point of the work plane."""

from __future__ import annotations

from typing import NamedTuple


class Point(NamedTuple):
    """A point, millimetres: x to the right, y up. A plain ``(x, y)`` pair does wherever a point is taken."""

    x_mm: float
    y_mm: float

"""By which method a move is planned, and how hard to look for it."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import timedelta
from enum import Enum


class Algorithm(Enum):
    """How a rapid move is planned."""

    EXACT = "exact"
    """The shortest path, proven."""
    SUPPORTING_LINES = "supporting lines"
    """The scan published in 2008, for comparison: one obstacle with straight edges, mitred, no work area."""


@dataclass(frozen=True)
class Effort:
    """The defaults give the shortest path within the call's deadline."""

    algorithm: Algorithm = Algorithm.EXACT
    time_limit: timedelta | None = None
    """Stop after this long. None: shortly before the call's deadline."""
    iteration_limit: int = 0
    """Stop after so many search nodes: the same answer on every machine. 0: no such limit."""

"""What the service answers."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import timedelta

from .path import Path
from .point import Point
from .scene import Scene


@dataclass(frozen=True)
class Stats:
    """What planning took; varies from run to run."""

    barrier_vertex_count: int
    """Corners and arcs of barriers that the search looked at."""
    expanded_node_count: int
    """Search nodes that were expanded."""
    prepare: timedelta
    """From the call's arrival to the first search step."""
    search: timedelta
    """What the engine took."""


@dataclass(frozen=True)
class RapidPlan:
    """A collision-free path and how good it is. Shows itself with its scene in notebooks."""

    scene: Scene
    """What was asked."""
    path: Path
    cost_mm: float
    """Travel, millimetres."""
    lower_bound_mm: float
    """No collision-free path is shorter. Equal to ``cost_mm`` when optimality is proven."""
    bending_obstacle_ids: tuple[str, ...]
    """Obstacles that bend the path, in path order; ``work_area`` where its border does."""
    alternatives: tuple[Path, ...]
    """For the scan of 2008: its two candidates, shortest first. Otherwise empty."""
    stats: Stats

    @property
    def start(self) -> Point:
        """Where the path begins."""
        return self.path.start

    @property
    def target(self) -> Point:
        """Where the path ends."""
        return self.path.end

    def _repr_svg_(self) -> str:
        from .picture import picture

        return picture(self.scene, path=self.path)


@dataclass(frozen=True)
class NoPath:
    """Proven: there is no collision-free path. An answer, not an error."""

    scene: Scene
    """What was asked."""
    start: Point
    target: Point
    separating_obstacle_ids: tuple[str, ...]
    """Obstacles that, with the work area's border, part start from target. Empty: the border alone does."""
    stats: Stats

    def _repr_svg_(self) -> str:
        from .picture import picture

        return picture(self.scene, start=self.start, target=self.target, marked=self.separating_obstacle_ids)


@dataclass(frozen=True)
class ToolChangePlan:
    """Where to change the tool, and both moves."""

    place: Point
    """Where the tool is changed."""
    approach: RapidPlan
    """From the start to the place."""
    departure: RapidPlan
    """From the place to the target."""
    cost_mm: float
    """Of both moves, millimetres."""
    lower_bound_mm: float
    """No permitted place costs less. Equal to ``cost_mm`` when proven; lower by at most 1e-9 of it on arcs."""


@dataclass(frozen=True)
class Violation:
    """One thing that a path or a layout does against its request."""

    field: str
    """Into the plan, such as ``path.steps[7]``."""
    reason: str
    """For programs; docs/errors.md explains each."""
    message: str
    """For people."""
    amount: float
    """By how much, millimetres unless the reason says otherwise."""
    at: Point | None
    """Where it is worst."""
    obstacle_id: str
    """The obstacle concerned, or ``work_area``; in a layout the other section; empty when none is."""


@dataclass(frozen=True)
class Check:
    """What the checker found."""

    violations: tuple[Violation, ...]
    """Empty: the path, or the layout, is sound."""
    cost_mm: float
    """Recomputed, millimetres: travel, or the length of a layout."""
    smallest_margin_mm: float | None
    """Least distance beyond the clearance, or the gap; negative: too near. None: nothing is in the way."""
    certified_bound_mm: float | None = None
    """No layout is shorter: recomputed from its certificate. None: a path, or a layout that came without one."""


@dataclass(frozen=True)
class Limits:
    """What a server accepts."""

    server_version: str
    message_bytes: int
    """Largest request, bytes."""
    coordinate_mm: float
    """Largest absolute value of a coordinate."""
    radius_mm: float
    """Largest radius of a circular edge."""
    vertex_count: int
    """Most vertices of one request."""
    obstacle_count: int
    """Most obstacles of one request."""
    step_count: int
    """Most steps of a path to check."""
    queued_call_count: int
    """Calls that may wait for a free core."""
    default_time_limit: timedelta
    """Of a request that names none."""
    longest_time_limit: timedelta
    """A longer one is cut to it."""
    section_count: int
    """Most sections of one layout, every copy counted."""
    part_count: int
    """Most parts of all sections of one request."""
    join_count: int
    """Most entries of a matrix of effects that is answered."""

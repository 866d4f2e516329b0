"""Sections of a cutting layout and the order in which they join tightest."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from datetime import timedelta
from enum import Enum

from .ring import Ring
from .scene import Polygon


class Pose(Enum):
    """How a whole section is turned, about the centre of its own bounding box."""

    AS_IS = "as is"
    HALF_TURN = "half turn"
    MIRROR_X = "mirror x"
    """Left and right swapped."""
    MIRROR_Y = "mirror y"
    """Top and bottom swapped."""


@dataclass(frozen=True, init=False)
class Section:
    """Parts that stay together, where they lie. A part is a ring, or a polygon with holes.

    >>> Section("slab", [Ring.rectangle(0, 0, 40, 20)], quantity=2).parts[0].holes
    ()
    """

    id: str
    """Unique in the layout, at most 256 bytes."""
    parts: tuple[Polygon, ...]
    quantity: int
    poses: tuple[Pose, ...]

    def __init__(
        self, id: str, parts: Iterable[Ring | Polygon], *, quantity: int = 1, poses: Iterable[Pose] = (Pose.AS_IS,)
    ) -> None:
        """A section.

        quantity: how many copies the layout holds.
        poses: how it may be turned.
        """
        polygons = tuple(part if isinstance(part, Polygon) else Polygon(part) for part in parts)
        for name, value in {"id": id, "parts": polygons, "quantity": quantity, "poses": tuple(poses)}.items():
            object.__setattr__(self, name, value)


@dataclass(frozen=True)
class PlacedSection:
    """One copy of a section in a layout."""

    section_id: str
    copy: int
    """Which of its copies, from 0."""
    pose: Pose
    x_mm: float
    """Left edge of its bounding box."""
    y_mm: float
    """Lower edge of its bounding box: as the section was sent."""


@dataclass(frozen=True)
class Certificate:
    """What proves a lower bound of a layout without any search."""

    lower_bound_mm: float
    """The bound that it is said to prove; ``check_sections`` recomputes it."""
    encoded: bytes
    """The message ``traverse.v1.Certificate``."""


@dataclass(frozen=True)
class Layout:
    """The shortest layout that was found, and how good it is known to be."""

    order: tuple[PlacedSection, ...]
    """Left to right. Empty: there is no order that the rules allow, proven."""
    length_mm: float
    """From the start of the strip to the right end of what reaches furthest."""
    bounding_box_length_mm: float
    """The same order joined by bounding boxes."""
    lower_bound_mm: float
    """No layout that is reached by sliding is shorter."""
    proven: bool
    """Whether length and bound met, or it is proven that there is no order."""
    search: timedelta
    """What the engine took."""
    certificate: Certificate | None = None
    """What proves a part of the bound. None: there is none."""


@dataclass(frozen=True)
class LayoutRules:
    """How sections are joined. The defaults join them tightly, none passing the left edge of the one before it."""

    gap_mm: float = 0.0
    """Kept between parts of different sections."""
    strip_height_mm: float | None = None
    """No section may be higher. None: not checked."""
    may_tuck_in: bool = False
    """Whether sections may slide past the left edge of the one before them."""
    first: str = ""
    """Id of a section of which one copy comes first. Empty: free."""
    last: str = ""
    """Id of a section of which one copy comes last. Empty: free."""
    precedences: tuple[tuple[str, str], ...] = ()
    """Ids (before, after): all copies of the one before all of the other."""
    forbidden_joins: tuple[tuple[str, str], ...] = ()
    """Ids (left, right) that must not be neighbours in this order."""

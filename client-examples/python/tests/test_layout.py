"""Orders of sections by a live server."""

from dataclasses import replace
from datetime import timedelta

import pytest

from traverse import Client, LayoutRules, Path, Pose, RequestRefused, Ring, Section


def outline(*corners: tuple[float, float]) -> Ring:
    path = Path.begin(corners[0])
    for corner in corners[1:]:
        path = path.line_to(corner)
    return Ring.from_path(path)


# A point to the right, and a notch for it at the left.
ARROW = Section("arrow", [outline((0, 0), (60, 0), (100, 50), (60, 100), (0, 100))])
NOTCH = Section("notch", [outline((0, 0), (90, 0), (90, 100), (0, 100), (40, 50))])


def test_sections_join_tightly_and_the_check_finds_them_sound(client: Client) -> None:
    layout = client.order_sections([NOTCH, ARROW], time_limit=timedelta(seconds=5))
    assert [placed.section_id for placed in layout.order] == ["arrow", "notch"]
    assert layout.length_mm == pytest.approx(150, abs=1e-5)
    assert layout.bounding_box_length_mm == pytest.approx(190)
    assert layout.proven and layout.lower_bound_mm == layout.length_mm
    sound = client.check_sections([NOTCH, ARROW], LayoutRules(), layout.order)
    assert sound.violations == () and sound.cost_mm == pytest.approx(layout.length_mm)
    assert sound.certified_bound_mm is None
    assert layout.certificate is not None
    proven = client.check_sections([NOTCH, ARROW], LayoutRules(), layout.order, certificate=layout.certificate)
    assert proven.violations == ()
    assert proven.certified_bound_mm == pytest.approx(layout.certificate.lower_bound_mm, abs=1e-5)
    bolder = replace(layout.certificate, lower_bound_mm=layout.certificate.lower_bound_mm + 1)
    claimed = client.check_sections([NOTCH, ARROW], LayoutRules(), layout.order, certificate=bolder)
    assert [each.reason for each in claimed.violations] == ["BOUND_NOT_PROVEN"]
    nearer = (layout.order[0], replace(layout.order[1], x_mm=layout.order[1].x_mm - 1))
    found = client.check_sections([NOTCH, ARROW], LayoutRules(), nearer)
    assert [each.reason for each in found.violations] == ["SECTIONS_OVERLAP"]
    assert found.violations[0].obstacle_id == "arrow"


def test_poses_quantities_and_rules_are_kept(client: Client) -> None:
    wedge = Section("wedge", [outline((0, 0), (40, 0), (0, 30))], quantity=3, poses=tuple(Pose))
    rules = LayoutRules(gap_mm=2, may_tuck_in=True, first="notch", forbidden_joins=(("notch", "arrow"),))
    layout = client.order_sections([ARROW, wedge, NOTCH], rules, time_limit=timedelta(seconds=5))
    assert len(layout.order) == 5 and layout.order[0].section_id == "notch"
    assert layout.order[1].section_id == "wedge"
    assert client.check_sections([ARROW, wedge, NOTCH], rules, layout.order).violations == ()


def test_what_is_wrong_is_found_at_once(client: Client) -> None:
    rules = LayoutRules(gap_mm=-1, first="nobody", precedences=(("arrow", "none"),))
    with pytest.raises(RequestRefused) as refused:
        client.order_sections([ARROW, Section("empty", [])], rules)
    assert [finding.field for finding in refused.value.findings] == [
        "gap_mm",
        "sections[1].parts",
        "first_section_id",
        "precedences[0].after_section_id",
    ]


def test_limits_are_told(client: Client) -> None:
    limits = client.limits()
    assert limits.section_count > 0 and limits.part_count > 0 and limits.join_count > 0

"""Pictures are well-formed, hold what they show, and keep inside their frame."""

import re
from xml.etree import ElementTree

import pytest

from traverse import Client, NoPath, Obstacle, Path, Polygon, RapidPlan, Ring, Scene, picture

SVG = "{http://www.w3.org/2000/svg}"
NASTY = 'a<b>&"c"\''


def shapes(text: str) -> list[tuple[str, str]]:
    """Class and title of every shape."""
    root = ElementTree.fromstring(text)
    assert root.tag == f"{SVG}svg"
    return [
        (shape.attrib["class"], title.text or "")
        for shape in root
        if "class" in shape.attrib and (title := shape.find(f"{SVG}title")) is not None
    ]


def test_a_plan_shows_itself_with_its_scene(client: Client) -> None:
    frame = Polygon(Ring.rectangle(0, 0, 60, 40), (Ring.circle((30, 20), 10),))
    scene = Scene([Obstacle(NASTY, frame)], clearance_mm=3, work_area=Ring.rectangle(-50, -50, 200, 150))
    plan = client.plan_rapid_move(scene, (-10, 5), (80, 5))
    assert isinstance(plan, RapidPlan)
    shown = shapes(plan._repr_svg_())
    assert [kind for kind, _ in shown] == ["area", "obstacle", "path", "start", "target"]
    assert shown[1][1] == NASTY
    assert shown[2][1] == f"{plan.cost_mm:.3f} mm"
    assert [kind for kind, _ in shapes(scene._repr_svg_())] == ["area", "obstacle"]


def test_no_path_marks_what_is_in_between(client: Client) -> None:
    ring = Polygon(Ring.circle((0, 0), 30), (Ring.circle((0, 0), 20),))
    scene = Scene([Obstacle("ring", ring), Obstacle("far", Ring.circle((90, 0), 5))], clearance_mm=1)
    answer = client.plan_rapid_move(scene, (0, 0), (50, 0))
    assert isinstance(answer, NoPath)
    assert [kind for kind, _ in shapes(answer._repr_svg_())] == ["marked", "obstacle", "start", "target"]


@pytest.mark.parametrize(
    "scene",
    [
        Scene(clearance_mm=1),
        Scene([Obstacle("nothing", Ring(()))], clearance_mm=1),
        Scene([Obstacle("needle", Ring.rectangle(0, 0, 1e6, 1e-3))], clearance_mm=1),
        Scene([Obstacle("arcs", Ring.circle((1e5, -1e5), 3e4))], clearance_mm=1),
    ],
)
def test_any_scene_makes_a_picture_that_keeps_inside(scene: Scene) -> None:
    text = picture(scene, path=Path.begin((0, 0)).arc_to((0, 0), center=(5, 0)))
    root = ElementTree.fromstring(text)
    _, _, width, height = map(float, root.attrib["viewBox"].split())
    assert 0 < width <= 721 and 0 < height <= 541
    for shape in root.iter(f"{SVG}path"):
        for x, y in re.findall(r"[ML]([-\d.e]+) ([-\d.e]+)", shape.attrib["d"]):
            assert -1 <= float(x) <= width + 1 and -1 <= float(y) <= height + 1


def test_arcs_turn_as_they_should() -> None:
    # Counter-clockwise with y up is sweep-flag 0 with y down.
    left = picture(Scene(clearance_mm=1), path=Path.begin((1, 0)).arc_to((0, 1), center=(0, 0)))
    right = picture(Scene(clearance_mm=1), path=Path.begin((0, 1)).arc_to((1, 0), center=(0, 0), clockwise=True))
    assert " 0 0 0 " in left and " 0 0 1 " not in left
    assert " 0 0 1 " in right and " 0 0 0 " not in right

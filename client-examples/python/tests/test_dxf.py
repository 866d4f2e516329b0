"""Drawings: the bundled ones, and such as ezdxf writes."""

import math
import subprocess
import sys
from pathlib import Path as File
from xml.etree import ElementTree

import ezdxf
import pytest
from ezdxf.document import Drawing

from traverse import Client, NoPath, Polygon, RapidPlan, Ring
from traverse.dxf import SceneFromDxf, read_scene

CLONE = File(__file__).parents[3]
SCRIPT = CLONE / "client-examples" / "python" / "examples" / "plan_from_dxf.py"


def read(document: Drawing, folder: File, join_mm: float = 0.01) -> SceneFromDxf:
    document.saveas(folder / "drawing.dxf")
    return read_scene(folder / "drawing.dxf", clearance_mm=1, join_mm=join_mm)


def new(version: str = "R2010", unit: int = 4) -> Drawing:
    document = ezdxf.filemanagement.new(version)
    document.units = unit
    return document


def outer(found: SceneFromDxf, number: int = 0) -> Ring:
    shape = found.scene.obstacles[number].shape
    assert isinstance(shape, Polygon)
    return shape.outer


@pytest.mark.parametrize(
    ("drawing", "start", "target", "clearance_mm", "round_what"),
    [
        ("vise-and-clamps", (30, 150), (570, 150), 5, "VISE/1"),
        ("vise-and-clamps", (230, 155), (300, 80), 5, "STOP/1"),
        ("vise-and-clamps", (110, 155), (570, 150), 5, None),
        ("turned-shaft", (100, 38), (206, 38), 4, "SHAFT/1"),
        ("turned-shaft", (70, 60), (310, 30), 4, "SHAFT/1"),
        ("leather-hide", (210, 300), (1120, 480), 6, "PIECES/5"),
        ("leather-hide", (308, 374), (1000, 640), 6, "PIECES/2"),
    ],
)
def test_bundled_drawings(
    client: Client,
    drawing: str,
    start: tuple[float, float],
    target: tuple[float, float],
    clearance_mm: float,
    round_what: str | None,
) -> None:
    found = read_scene(CLONE / "drawings" / f"{drawing}.dxf", clearance_mm=clearance_mm)
    assert found.unused == ()
    answer = client.plan_rapid_move(found.scene, start, target)
    ElementTree.fromstring(answer._repr_svg_())
    if round_what is None:
        assert isinstance(answer, NoPath)
    else:
        assert isinstance(answer, RapidPlan)
        assert round_what in answer.bending_obstacle_ids
        assert client.check_rapid_move(found.scene, start, target, answer.path).violations == ()


@pytest.mark.parametrize("version", ["R12", "R2000", "R2018"])
def test_shapes_arrive(version: str, tmp_path: File) -> None:
    document = new(version)
    space = document.modelspace()
    corners = [(0, 0, 0, 0, 0), (10, 0, 0, 0, 1), (10, 10, 0, 0, 0), (0, 10, 0, 0, 0)]
    if version == "R12":
        space.add_polyline2d([(x, y, bulge) for x, y, _, _, bulge in corners], format="xyb", close=True)
    else:
        space.add_lwpolyline(corners, close=True)
    space.add_circle((50, 0), 5)
    space.add_text("a note")
    found = read(document, tmp_path)
    assert outer(found, 0).length_mm == pytest.approx(30 + 5 * math.pi)
    assert max(point.x_mm for point in outer(found, 0).points()) == pytest.approx(15, abs=0.01)
    assert outer(found, 1).length_mm == pytest.approx(10 * math.pi)
    assert found.unused == ()
    assert len(found.annotations) == 1 and "TEXT" in found.annotations[0]


def test_inches_are_millimetres_here(tmp_path: File) -> None:
    document = new(unit=1)
    document.modelspace().add_circle((1, 2), 1)
    assert outer(read(document, tmp_path)).length_mm == pytest.approx(2 * math.pi * 25.4)


def test_mirrored_extrusion_turns_x_and_bulges(tmp_path: File) -> None:
    document = new()
    space = document.modelspace()
    down = {"extrusion": (0, 0, -1)}
    space.add_lwpolyline(
        [(0, 0, 0, 0, 0), (10, 0, 0, 0, 1), (10, 10, 0, 0, 0), (0, 10, 0, 0, 0)], close=True, dxfattribs=down
    )
    space.add_arc((30, 0), 5, 0, 180, dxfattribs=down)
    space.add_line((-35, 0), (-25, 0))
    space.add_circle((0, 0, 0), 3, dxfattribs={"extrusion": (1, 0, 0)})
    found = read(document, tmp_path)
    xs = [point.x_mm for point in outer(found).points(0.001)]
    assert min(xs) == pytest.approx(-15, abs=0.01) and max(xs) == 0
    ys = [point.y_mm for point in outer(found, 1).points(0.001)]
    assert max(ys) == pytest.approx(5, abs=0.01) and min(ys) == pytest.approx(0, abs=1e-9)
    assert found.unused == ("layer 0: CIRCLE, 1 not read",)


def test_blocks_are_taken_apart(tmp_path: File) -> None:
    document = new()
    block = document.blocks.new("CLAMP")
    block.add_circle((0, 0), 2)
    outside = document.blocks.new("PAIR")
    outside.add_blockref("CLAMP", (0, 0))
    outside.add_blockref("CLAMP", (10, 0), {"xscale": 2, "yscale": 2})
    document.modelspace().add_blockref("PAIR", (100, 0), {"layer": "FIXTURE", "rotation": 90})
    found = read(document, tmp_path)
    assert [each.id for each in found.scene.obstacles] == ["FIXTURE/1", "FIXTURE/2"]
    assert outer(found, 1).length_mm == pytest.approx(8 * math.pi)
    assert outer(found, 1).points()[0].y_mm == pytest.approx(10, abs=5)


def test_ellipses_and_splines_keep_the_tolerance(tmp_path: File) -> None:
    document = new()
    document.modelspace().add_ellipse((0, 0), (20, 0), 0.5)
    document.modelspace().add_spline([(50, 0), (70, 0), (60, 20), (50, 0)])
    found = read(document, tmp_path)
    assert len(found.scene.obstacles) == 2
    assert all(abs((x / 20) ** 2 + (y / 10) ** 2 - 1) < 1e-3 for x, y in outer(found).points())


def test_lines_and_arcs_join_in_any_order_and_direction(tmp_path: File) -> None:
    document = new()
    space = document.modelspace()
    space.add_line((0, 0.004), (0, 10))
    space.add_line((10, 10), (0, 10))
    space.add_arc((10, 5), 5, -90, 90)
    space.add_line((0, 0), (10, 0))
    ring = outer(read(document, tmp_path))
    assert len(ring.vertices) == 4
    assert ring.length_mm == pytest.approx(30 + 5 * math.pi, abs=0.01)
    assert len(read(document, tmp_path, join_mm=0.001).unused) == 1


def test_what_is_open_is_said_and_not_used(tmp_path: File) -> None:
    document = new()
    document.modelspace().add_lwpolyline([(0, 0), (10, 0), (10, 10)])
    for end in ((60, 0), (50, 10), (60, 10)):  # more than two ends meet: which way is not guessed
        document.modelspace().add_line((50, 0), end)
    document.modelspace().add_solid([(0, 0), (1, 0), (0, 1)])
    found = read(document, tmp_path)
    assert found.scene.obstacles == ()
    assert sum("open chain" in line for line in found.unused) == 4
    assert any("SOLID" in line for line in found.unused)


def test_nesting_makes_holes_and_islands(tmp_path: File) -> None:
    document = new()
    for radius in (10, 40, 20, 30):
        document.modelspace().add_circle((0, 0), radius)
    shapes = [each.shape for each in read(document, tmp_path).scene.obstacles]
    assert all(isinstance(shape, Polygon) and len(shape.holes) == 1 for shape in shapes)
    lengths = [shape.outer.length_mm for shape in shapes if isinstance(shape, Polygon)]
    assert lengths == pytest.approx([80 * math.pi, 40 * math.pi])


def entities(*groups: tuple[int, object]) -> str:
    """A file of entities alone, without header; each group is code and value."""
    lines = [f"{code}\n{value}" for code, value in groups]
    return "\n".join(["0\nSECTION\n2\nENTITIES", *lines, "0\nENDSEC\n0\nEOF\n"])


CIRCLE = ((0, "CIRCLE"), (8, "0"), (10, 1.0), (20, 2.0), (40, 5.0))


def test_without_header_the_unit_is_assumed(tmp_path: File) -> None:
    file = tmp_path / "bare.dxf"
    # A text that speaks of the unit does not name it.
    file.write_text(entities(*CIRCLE, (0, "TEXT"), (8, "0"), (10, 0.0), (20, 0.0), (40, 1.0), (1, "$INSUNITS")))
    found = read_scene(file, clearance_mm=1)
    assert found.unit_assumed and found.millimetres == 1
    assert outer(found).length_mm == pytest.approx(10 * math.pi)
    inches = read_scene(file, clearance_mm=1, unit="inch")
    assert inches.unit_assumed and outer(inches).length_mm == pytest.approx(254 * math.pi)


def test_a_stated_unit_counts_in_text_and_binary(tmp_path: File) -> None:
    document = new(unit=6)
    document.modelspace().add_circle((0, 0), 1)
    for kind in ("asc", "bin"):
        document.saveas(tmp_path / "metres.dxf", fmt=kind)
        found = read_scene(tmp_path / "metres.dxf", clearance_mm=1, unit="inch")
        assert not found.unit_assumed and found.millimetres == 1000, kind
    document.units = 0
    document.saveas(tmp_path / "none.dxf")
    found = read_scene(tmp_path / "none.dxf", clearance_mm=1, unit="inch")
    assert found.unit_assumed and found.millimetres == 25.4


def test_a_band_is_not_its_centre_line(tmp_path: File) -> None:
    square = [(0, 0), (10, 0), (10, 10), (0, 10)]
    document = new()
    space = document.modelspace()
    space.add_lwpolyline(square, close=True, dxfattribs={"const_width": 10, "layer": "CONSTANT"})
    space.add_lwpolyline([(x, y, 0, 2) for x, y in square], format="xyse", close=True, dxfattribs={"layer": "{}"})
    space.add_polyline2d(square, close=True, dxfattribs={"default_end_width": 1, "layer": "OLD"})
    space.add_lwpolyline(square, close=True, dxfattribs={"const_width": 0, "layer": "THIN"})
    found = read(document, tmp_path)
    assert [line.split(" with a width")[0] for line in found.unused] == [
        "layer CONSTANT: LWPOLYLINE, 1",
        "layer OLD: POLYLINE, 1",
        "layer {}: LWPOLYLINE, 1",
    ]


def test_what_climbs_is_told(tmp_path: File) -> None:
    document = new()
    document.modelspace().add_line((0, 0, 0), (10, 0, 5))
    document.modelspace().add_line((0, 0, 7), (10, 0, 7))
    found = read(document, tmp_path)
    assert found.annotations == ("layer 0: LINE, 1 at varying height: taken as seen from above",)


def test_types_without_extrusion_and_missing_blocks_are_counted(tmp_path: File) -> None:
    file = tmp_path / "odd.dxf"
    leader = (
        (0, "LEADER"),
        (100, "AcDbEntity"),
        (8, "0"),
        (100, "AcDbLeader"),
        (76, 2),
        (10, 0.0),
        (20, 0.0),
        (10, 5.0),
        (20, 5.0),
    )
    insert = ((0, "INSERT"), (8, "0"), (2, "NOWHERE"), (10, 0.0), (20, 0.0))
    array = (*insert, (70, 2), (44, 5.0))
    file.write_text(entities(*CIRCLE, *leader, *insert, *array))
    found = read_scene(file, clearance_mm=1)
    assert len(found.scene.obstacles) == 1
    assert found.annotations == ("layer 0: LEADER, 1 not read",)
    assert found.unused == ("layer 0: INSERT, 2 not read",)


def test_two_work_areas_are_refused(tmp_path: File) -> None:
    document = new()
    for x in (0, 100):
        document.modelspace().add_circle((x, 0), 10, {"layer": "Work_Area"})
    with pytest.raises(ValueError, match="2 outlines"):
        read(document, tmp_path)


def test_the_script_plans_and_draws(address: str, tmp_path: File) -> None:
    def run(target: str, *more: str) -> subprocess.CompletedProcess[str]:
        drawing = CLONE / "drawings" / "vise-and-clamps.dxf"
        start = "30,150" if target != "300,80" else "110,155"
        command = [str(drawing), "--from", start, "--to", target, "--clearance", "5", "--server", address, *more]
        return subprocess.run([sys.executable, str(SCRIPT), *command], capture_output=True, text=True, timeout=120)

    done = run("570,150", "--output", str(tmp_path / "plan.svg"))
    assert done.returncode == 0, done.stderr
    assert "lower bound" in done.stdout and "TEXT" in done.stderr
    ElementTree.parse(tmp_path / "plan.svg")
    assert run("300,80").returncode == 4
    inside = run("1e9,0")
    assert inside.returncode == 1 and "COORDINATE_TOO_LARGE" in inside.stderr
    near = run("570,150", "--from", "-50,-50")
    assert near.returncode == 1 and "START" in near.stderr.upper(), near.stderr
    broken = tmp_path / "broken.dxf"
    broken.write_text("0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n")
    command = [sys.executable, str(SCRIPT), str(broken), "--from", "0,0", "--to", "1,1", "--clearance", "1"]
    refused = subprocess.run(command, capture_output=True, text=True, timeout=120)
    assert refused.returncode == 3 and "Traceback" not in refused.stderr, refused.stderr

"""Writes DXF files of every kind of entity with ezdxf, and beside each what must be read from it.

usage: ezdxf_files.py DIRECTORY

For every version from R12 to R2018, ASCII and binary, and every theme below: DIRECTORY/THEME-VERSION-KIND.dxf and
.json. The JSON holds the unit, counts of what can't be used, and every curve in file order: layer, colour, length,
bounding box, and whether it is exact (lines and circular arcs). Lengths and boxes come from ezdxf: INSERTs are exploded
by virtual_entities, splines and ellipses integrated by their own derivatives.
"""

import json
import math
import pathlib
import sys

import ezdxf
import numpy as np
from ezdxf import colors
from ezdxf.math import Vec2, Vec3, bulge_to_arc

VERSIONS = ["R12", "R2000", "R2004", "R2007", "R2010", "R2013", "R2018"]
ANNOTATION = {"TEXT", "MTEXT", "POINT", "ATTRIB", "ATTDEF", "DIMENSION"}
BODIES = {"3DFACE", "MESH", "3DSOLID"}
NODES, WEIGHTS = np.polynomial.legendre.leggauss(24)


def integrated(point, derivative, breaks):
    """Length and box of a curve that is smooth between breaks."""
    length, points = 0.0, []
    for low, high in zip(breaks, breaks[1:]):
        steps = 16
        for i in range(steps):
            a, b = low + (high - low) * i / steps, low + (high - low) * (i + 1) / steps
            middle, half = (a + b) / 2, (b - a) / 2
            length += half * sum(
                w * math.hypot(*derivative(middle + half * x)) for x, w in zip(NODES, WEIGHTS)
            )
        points += [point(low + (high - low) * i / 400) for i in range(401)]
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    return length, [min(xs), min(ys), max(xs), max(ys)]


def of_ellipse(entity):
    center, axis = Vec3(entity.dxf.center), Vec3(entity.dxf.major_axis)
    other = Vec3(entity.dxf.extrusion).normalize().cross(axis) * entity.dxf.ratio
    start, end = entity.dxf.start_param, entity.dxf.end_param
    sweep = (end - start) % math.tau or math.tau
    breaks = [start + sweep * i / 8 for i in range(9)]
    point = lambda t: (center + axis * math.cos(t) + other * math.sin(t)).vec2
    derivative = lambda t: (other * math.cos(t) - axis * math.sin(t)).vec2
    return integrated(point, derivative, breaks)


def of_spline(entity):
    tool = entity.construction_tool()
    knots = list(tool.knots())
    first, last = knots[tool.order - 1], knots[tool.count]
    breaks = sorted({knot for knot in knots if first <= knot <= last})
    inside = lambda t: min(max(t, first), last)
    point = lambda t: tool.point(inside(t)).vec2
    derivative = lambda t: tool.derivative(inside(t), 1)[1].vec2
    return integrated(point, derivative, breaks)


def of_arcs(points, closed):
    """Length and box of (x, y, bulge) vertices."""
    length, box = 0.0, []
    ends = points[1:] + points[:1] if closed else points[1:]
    for (ax, ay, bulge), (bx, by, _) in zip(points, ends):
        box += [(ax, ay), (bx, by)]
        if bulge == 0.0 or (ax, ay) == (bx, by):
            length += math.hypot(bx - ax, by - ay)
            continue
        center, start, end, radius = bulge_to_arc((ax, ay), (bx, by), bulge)
        length += radius * 4.0 * math.atan(abs(bulge))
        box += on_axes(center, radius, start, end)
    return length, around(box)


def on_axes(center, radius, start, end):
    sweep = (end - start) % math.tau or math.tau
    quarters = [i * math.pi / 2 for i in range(4)]
    return [
        (center[0] + radius * math.cos(q), center[1] + radius * math.sin(q))
        for q in quarters
        if (q - start) % math.tau <= sweep
    ]


def around(points):
    xs, ys = [p[0] for p in points], [p[1] for p in points]
    return [min(xs), min(ys), max(xs), max(ys)]


def of_circular(entity):
    ocs = entity.ocs()
    center, radius = Vec3(entity.dxf.center), entity.dxf.radius
    if entity.dxftype() == "CIRCLE":
        start, end = 0.0, math.tau
    else:
        start, end = math.radians(entity.dxf.start_angle), math.radians(entity.dxf.end_angle)
    sweep = (end - start) % math.tau or math.tau
    ends = [
        (center.x + radius * math.cos(angle), center.y + radius * math.sin(angle)) for angle in (start, end)
    ]
    if sweep == math.tau:
        ends = []
    box = [ocs.to_wcs(Vec3(*p)) for p in ends + on_axes(center, radius, start, end)]
    return radius * sweep, around([(p.x, p.y) for p in box])


def of_polyline(entity):
    if entity.dxftype() == "LWPOLYLINE":
        points = [tuple(p) for p in entity.get_points("xyb")]
        closed, sign = entity.closed, entity.dxf.extrusion.z
    else:
        closed, sign = entity.is_closed, 1.0
        vertices = [v for v in entity.vertices if not (entity.dxf.flags & 4 and v.dxf.flags & 16)]
        if entity.is_2d_polyline:
            sign = entity.dxf.extrusion.z
            points = [(v.dxf.location.x, v.dxf.location.y, v.dxf.get("bulge", 0.0)) for v in vertices]
        else:
            points = [(v.dxf.location.x, v.dxf.location.y, 0.0) for v in vertices]
    if sign < 0.0:
        points = [(-x, y, -b) for x, y, b in points]
    return of_arcs(points, closed)


def measured(entity):
    """Length, box and whether arcs stand for it exactly."""
    kind = entity.dxftype()
    if kind == "LINE":
        a, b = entity.dxf.start, entity.dxf.end
        return math.hypot(b.x - a.x, b.y - a.y), around([(a.x, a.y), (b.x, b.y)]), True
    if kind in ("ARC", "CIRCLE"):
        return *of_circular(entity), True
    if kind in ("LWPOLYLINE", "POLYLINE"):
        return *of_polyline(entity), True
    if kind == "ELLIPSE":
        return *of_ellipse(entity), False
    if kind == "SPLINE":
        return *of_spline(entity), False
    return None


def color_of(entity, layer, block_color):
    if entity.dxf.hasattr("true_color"):
        return "#%02x%02x%02x" % tuple(entity.rgb)
    index = entity.dxf.get("color", 256)
    if index == 0:
        return block_color
    if index == 256:
        index = layer.dxf.color
        if layer.rgb is not None:
            return "#%02x%02x%02x" % tuple(layer.rgb)
    return "#%02x%02x%02x" % tuple(colors.aci2rgb(abs(index)))


class Expected:
    def __init__(self, doc):
        self.doc, self.curves, self.unused = doc, [], {}

    def drop(self, layer, entity, why):
        key = f"{layer}|{entity}|{why}"
        self.unused[key] = self.unused.get(key, 0) + 1

    def add(self, entity, layer0=None, block_color="#ffffff", groups=()):
        kind = entity.dxftype()
        layer = layer0 if layer0 and entity.dxf.layer == "0" else entity.dxf.layer
        color = color_of(entity, self.doc.layers.get(layer), block_color)
        if kind == "INSERT":
            if entity.block() is None:
                return self.drop(layer, kind, "UnknownBlock")
            groups = (*groups, entity.dxf.name)
            for single in entity.multi_insert() if entity.mcount > 1 else [entity]:
                for inside in single.virtual_entities():
                    self.add(inside, layer, color, groups)
                for definition in entity.block().query("ATTDEF"):
                    self.drop(layer if definition.dxf.layer == "0" else definition.dxf.layer, "ATTDEF", "Annotation")
            for attribute in entity.attribs:
                self.drop(attribute.dxf.layer, "ATTRIB", "Annotation")
            return None
        if kind == "POLYLINE" and (entity.is_poly_face_mesh or entity.is_polygon_mesh):
            return self.drop(layer, kind, "Body")
        found = measured(entity)
        if found is None:
            why = "Annotation" if kind in ANNOTATION else "Body" if kind in BODIES else "Type"
            return self.drop(layer, kind, why)
        length, box, exact = found
        self.curves.append(
            {"layer": layer, "color": color, "length": length, "box": box, "exact": exact, "groups": groups}
        )
        if climbs(entity):
            self.drop(layer, kind, "Height")
        return None


def climbs(entity):
    """Whether it is in 3D: read as seen from above, and counted."""
    kind = entity.dxftype()
    if kind == "LINE":
        heights = [entity.dxf.start.z, entity.dxf.end.z]
    elif kind == "POLYLINE":
        heights = [vertex.dxf.location.z for vertex in entity.vertices]
    elif kind == "SPLINE":
        heights = [point[2] for points in (entity.control_points, entity.fit_points) for point in points]
    else:
        heights = []
    return bool(heights) and max(heights) - min(heights) > 1e-9


def lines_and_arcs(doc, msp):
    msp.add_line((0, 0), (30, 40), dxfattribs={"layer": "Cut"})
    msp.add_line((1, 2, 3), (4, 6, 90), dxfattribs={"layer": "Cut", "color": 12})
    msp.add_circle((10, -5), 7.25, dxfattribs={"layer": "Mark", "color": 0})
    msp.add_arc((3, 4), 5, 300, 30, dxfattribs={"layer": "Mark"})
    msp.add_arc((3, 4), 5, 30, 300, dxfattribs={"layer": "0"})
    for kind in ("circle", "arc"):
        attributes = {"layer": "Cut", "extrusion": (0, 0, -1)}
        if kind == "circle":
            msp.add_circle((20, 6), 3, dxfattribs=attributes)
        else:
            msp.add_arc((20, 6), 3, 10, 100, dxfattribs=attributes)
    msp.add_text("outline", dxfattribs={"layer": "Öl 中"})
    msp.add_point((1, 1), dxfattribs={"layer": "Mark"})


def polylines(doc, msp):
    points = [(0, 0, 0.5), (10, 0, -0.3), (10, 8, 0), (4, 12, 1), (0, 8, 3.0)]
    for closed in (False, True):
        for z in (1, -1):
            attributes = {"layer": "Cut", "extrusion": (0, 0, z)}
            msp.add_polyline2d(points, format="xyb", close=closed, dxfattribs=attributes)
            if doc.dxfversion > "AC1009":
                msp.add_lwpolyline(points, format="xyb", close=closed, dxfattribs=attributes)
    msp.add_polyline3d([(0, 0, 0), (3, 4, 12), (6, 0, 5)], close=True, dxfattribs={"layer": "Mark"})
    fitted = msp.add_polyline2d([(0, 0), (5, 9), (10, 0)], dxfattribs={"layer": "Mark", "flags": 4})
    for vertex in fitted.vertices:
        vertex.dxf.flags = 16
    fitted.append_vertices([(0, 0), (2, 3), (5, 4.5), (8, 3), (10, 0)], dxfattribs={"flags": 8})
    mesh = msp.add_polymesh((3, 3), dxfattribs={"layer": "Mark"})
    for i in range(3):
        for j in range(3):
            mesh.set_mesh_vertex((i, j), (i, j, i * j))
    cube = msp.add_polyface(dxfattribs={"layer": "Mark"})
    cube.append_faces([[(0, 0), (1, 0), (1, 1), (0, 1)]])


def smooth(doc, msp):
    cut = {"layer": "Cut"}
    msp.add_ellipse((5, 6), (10, 3), 0.4, dxfattribs=cut)
    msp.add_ellipse((5, 6), (10, 3), 0.4, 0.3, 4.0, dxfattribs=cut)
    msp.add_ellipse((-5, 6), (1, 30), 0.05, 5.0, 1.0, dxfattribs=cut)
    msp.add_ellipse((5, 6), (10, 3), 0.4, 0.3, 4.0, dxfattribs={**cut, "extrusion": (0, 0, -1)})
    controls = [(0, 0), (10, 30), (30, 30), (40, -10), (60, 0), (70, 20), (55, 50)]
    msp.add_open_spline(controls, degree=3, dxfattribs=cut)
    msp.add_open_spline(controls, degree=2, dxfattribs=cut)
    msp.add_open_spline(controls, degree=5, dxfattribs=cut)
    msp.add_rational_spline(controls, [1, 2, 0.5, 3, 1, 1, 2], degree=3, dxfattribs=cut)
    corner = msp.add_open_spline(controls, degree=3, dxfattribs=cut)
    corner.knots = [0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2]
    points = [(0, 0), (10, 20), (30, 22), (45, 3), (60, 12)]
    msp.add_spline(points, dxfattribs=cut)
    tangents = msp.add_spline(points, dxfattribs={"layer": "Mark"})
    tangents.dxf.start_tangent, tangents.dxf.end_tangent = (0, 5), (1, 1)


def inserts(doc, msp):
    plain = doc.blocks.new("Plain", base_point=(1, 2))
    plain.add_line((0, 0), (10, 0))
    plain.add_circle((5, 5), 2, dxfattribs={"color": 0})
    plain.add_arc((2, 3), 4, 20, 200, dxfattribs={"layer": "Mark", "color": 3})
    plain.add_polyline2d([(0, 0, 0.7), (6, 1, 0), (3, 8, -0.2)], format="xyb", close=True)
    plain.add_attdef("NAME", (0, 0), dxfattribs={"layer": "0"})
    plain.add_text("inside")
    if doc.dxfversion > "AC1009":
        plain.add_lwpolyline([(0, 0, 0.7), (6, 1, 0), (3, 8, -0.2)], format="xyb")
        plain.add_ellipse((3, 3), (4, 1), 0.5, 0.2, 3)
        plain.add_open_spline([(0, 0), (3, 5), (7, 5), (9, 0), (12, 2)])
    below = plain.add_circle((4, 1), 1.5)
    below.dxf.extrusion = (0, 0, -1)
    nest = doc.blocks.new("Nest", base_point=(-3, 0))
    nest.add_blockref("Plain", (4, 4), dxfattribs={"rotation": 30, "color": 0})
    nest.add_blockref("Plain", (-4, 4), dxfattribs={"layer": "Mark", "xscale": -1})
    deep = doc.blocks.new("Deep")
    deep.add_blockref("Nest", (7, 1), dxfattribs={"xscale": 2, "yscale": 2, "zscale": 2, "rotation": -71.3})
    for attributes in (
        {},
        {"rotation": 90},
        {"rotation": 33, "xscale": 2.5, "yscale": 2.5, "zscale": 2.5, "color": 5},
        {"xscale": -1},
        {"yscale": -2, "xscale": 2, "zscale": 2, "rotation": 12},
        {"extrusion": (0, 0, -1), "rotation": 40},
        {"extrusion": (0, 0, -1), "xscale": -3, "yscale": 3, "zscale": 3},
    ):
        for name in ("Plain", "Nest", "Deep"):
            msp.add_blockref(name, (100, 50), dxfattribs={"layer": "Cut", **attributes})
    array = {"column_count": 3, "row_count": 2, "column_spacing": 40, "row_spacing": 25, "rotation": 20}
    msp.add_blockref("Plain", (0, 0), dxfattribs={"layer": "Cut", **array})
    msp.add_blockref("Nest", (3, 0), dxfattribs={"layer": "Mark", **array, "xscale": -1})
    labelled = msp.add_blockref("Plain", (3, 0), dxfattribs={"layer": "Cut"})
    labelled.add_attrib("NAME", "A7", (1, 1), dxfattribs={"layer": "Mark"})
    msp.add_blockref("Missing", (0, 0), dxfattribs={"layer": "Cut"})


def stretched(doc, msp):
    block = doc.blocks.new("Round")
    block.add_circle((5, 5), 2)
    block.add_arc((2, 3), 4, 20, 200)
    block.add_line((0, 0), (3, 1))
    if doc.dxfversion > "AC1009":
        block.add_ellipse((3, 3), (4, 1), 0.5, 0.2, 3)
        block.add_open_spline([(0, 0), (3, 5), (7, 5), (9, 0), (12, 2)])
    for attributes in ({"xscale": 3}, {"yscale": -0.25, "rotation": 30}, {"xscale": 2, "yscale": 5}):
        msp.add_blockref("Round", (10, 20), dxfattribs={"layer": "Cut", **attributes})


def bodies_and_colours(doc, msp):
    msp.add_line((0, 0), (5, 0), dxfattribs={"layer": "Off"})
    msp.add_line((0, 1), (5, 1), dxfattribs={"layer": "Mark", "color": 255})
    # ezdxf's table has slips of the pen at some dark colours, such as 187.
    for index in (1, 32, 63, 94, 125, 156, 210, 246):
        msp.add_line((index, 0), (index, 7), dxfattribs={"layer": "Cut", "color": index})
    msp.add_3dface([(0, 0), (1, 0), (1, 1, 1)], dxfattribs={"layer": "Cut"})
    msp.add_solid([(0, 0), (1, 0), (1, 1)], dxfattribs={"layer": "Cut"})
    if doc.dxfversion > "AC1009":
        msp.add_mtext("text", dxfattribs={"layer": "Cut"})
        with msp.add_mesh(dxfattribs={"layer": "Cut"}).edit_data() as mesh:
            mesh.vertices, mesh.faces = [(0, 0, 0), (1, 0, 0), (1, 1, 5)], [(0, 1, 2)]
        line = msp.add_line((9, 9), (12, 13), dxfattribs={"layer": "Cut"})
        if doc.dxfversion > "AC1015":
            line.rgb = (1, 200, 37)
        hatch = msp.add_hatch(dxfattribs={"layer": "Cut"})
        hatch.paths.add_polyline_path([(0, 0), (1, 0), (1, 1)])


THEMES = [lines_and_arcs, polylines, smooth, inserts, stretched, bodies_and_colours]


def main() -> None:
    directory = pathlib.Path(sys.argv[1])
    directory.mkdir(parents=True, exist_ok=True)
    count = 0
    for version in VERSIONS:
        for theme in THEMES:
            if version == "R12" and theme is smooth:
                continue
            doc = ezdxf.new(version)
            inches = theme is polylines and version != "R12"
            if version != "R12":
                doc.header["$INSUNITS"] = 1 if inches else 4
            for name, color in (("Cut", 1), ("Mark", 94), ("Öl 中", 30), ("Off", 6)):
                doc.layers.add(name, color=color)
            if version >= "R2004" and version != "R12":
                doc.layers.get("Mark").rgb = (9, 8, 7)
            doc.layers.get("Off").off()
            theme(doc, doc.modelspace())
            expected = Expected(doc)
            for entity in doc.modelspace():
                expected.add(entity)
            factor = 25.4 if inches else 1.0
            for curve in expected.curves:
                curve["length"] *= factor
                curve["box"] = [value * factor for value in curve["box"]]
            facts = {"millimetres": factor, "curves": expected.curves, "unused": expected.unused}
            for kind in ("ascii", "binary"):
                stem = f"{theme.__name__}-{version}-{kind}"
                doc.saveas(directory / f"{stem}.dxf", fmt="bin" if kind == "binary" else "asc")
                (directory / f"{stem}.json").write_text(json.dumps(facts), encoding="utf-8")
                count += 1
    print(f"{count} files")


if __name__ == "__main__":
    main()

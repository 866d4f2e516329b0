"""Reads and audits DXF files with ezdxf; prints what is on their layers as JSON.

usage: ezdxf_roundtrip.py FILE.dxf...

For each file: version, unit ($INSUNITS), counts of audit errors and fixes, and by layer the count of entities and the
length of LINE, ARC, CIRCLE and LWPOLYLINE (bulges as arcs) in drawing units. If FILE.length stands beside FILE.dxf,
the length on TRAVERSE_PATH must be the one in it, to 1e-9. Exit code 1: a file does not read, audits with errors or
fixes, or differs in length.
"""

import json
import math
import pathlib
import sys

import ezdxf


def arc_length(chord: float, bulge: float) -> float:
    if bulge == 0.0:
        return chord
    radius = chord * (1.0 + bulge * bulge) / (4.0 * abs(bulge))
    return radius * 4.0 * math.atan(abs(bulge))


def length(entity) -> float:
    kind = entity.dxftype()
    if kind == "LINE":
        return entity.dxf.start.distance(entity.dxf.end)
    if kind == "CIRCLE":
        return math.tau * entity.dxf.radius
    if kind == "ARC":
        turn = (entity.dxf.end_angle - entity.dxf.start_angle) % 360.0
        return math.radians(turn or 360.0) * entity.dxf.radius
    if kind == "LWPOLYLINE":
        points = [(float(x), float(y), float(b)) for x, y, b in entity.get_points("xyb")]
        ends = points[1:] + points[:1] if entity.closed else points[1:]
        return math.fsum(
            arc_length(math.hypot(bx - ax, by - ay), bulge)
            for (ax, ay, bulge), (bx, by, _) in zip(points, ends)
        )
    return 0.0


def report(path: pathlib.Path) -> dict:
    document = ezdxf.readfile(path)
    audit = document.audit()
    layers: dict[str, dict] = {}
    for entity in document.modelspace():
        layer = layers.setdefault(entity.dxf.layer, {"entities": 0, "length": 0.0})
        layer["entities"] += 1
        layer["length"] += length(entity)
    found = {
        "file": str(path),
        "version": document.dxfversion,
        "unit": document.header.get("$INSUNITS", 0),
        "errors": [error.message for error in audit.errors],
        "fixes": [fix.message for fix in audit.fixes],
        "layers": layers,
    }
    expected = path.with_suffix(".length")
    if expected.exists():
        wanted = float(expected.read_text())
        drawn = layers.get("TRAVERSE_PATH", {"length": 0.0})["length"]
        found["expected_length"] = wanted
        found["length_agrees"] = abs(drawn - wanted) <= 1e-9 * max(1.0, wanted)
    return found


def main(names: list[str]) -> int:
    if not names:
        print(__doc__, file=sys.stderr)
        return 2
    reports = []
    for name in names:
        try:
            reports.append(report(pathlib.Path(name)))
        except (OSError, ezdxf.DXFError) as error:
            reports.append({"file": name, "errors": [str(error)], "fixes": []})
    json.dump(reports, sys.stdout, indent=2)
    print()
    sound = all(
        not found["errors"] and not found["fixes"] and found.get("length_agrees", True) for found in reports
    )
    return 0 if sound else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""Plans a rapid move through a DXF drawing and draws it.

plan_from_dxf.py drawings/vise-and-clamps.dxf --from 30,150 --to 570,150 --clearance 5 --output plan.svg
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path as File

from ezdxf.lldxf.const import DXFError

from traverse import CallFailed, Client, NoPath, Point
from traverse.dxf import read_scene


def main() -> int:
    """Exit codes: 0 done, 1 the call failed, 3 the drawing can't be used, 4 there is no path (proven)."""
    arguments = _arguments()
    try:
        found = read_scene(arguments.drawing, clearance_mm=arguments.clearance, unit=arguments.unit)
    except (OSError, ValueError, DXFError) as error:
        print(error, file=sys.stderr)
        return 3
    if found.unit_assumed:
        print(f"unit: {arguments.unit} (assumed: the file names none; --unit says another)", file=sys.stderr)
    for line in (*found.unused, *found.annotations):
        print(f"not used: {line}", file=sys.stderr)
    if found.unused and not arguments.ignore_unused:
        print("a path may run through what was not used: mend the drawing, or pass --ignore-unused", file=sys.stderr)
        return 3
    with Client(arguments.server, deadline=arguments.deadline) as client:
        try:
            answer = client.plan_rapid_move(found.scene, arguments.start, arguments.target)
        except CallFailed as failed:
            print(failed, file=sys.stderr)
            return 1
    if arguments.output is not None:
        arguments.output.write_text(answer._repr_svg_(), encoding="utf-8")
    if isinstance(answer, NoPath):
        print("no path: start and target are parted by", ", ".join(answer.separating_obstacle_ids) or "the border")
        return 4
    print(f"length       {answer.cost_mm:.6f} mm")
    print(f"lower bound  {answer.lower_bound_mm:.6f} mm")
    print(f"goes round   {', '.join(answer.bending_obstacle_ids)}")
    return 0


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Plans a rapid move through a DXF drawing and draws it.")
    parser.add_argument("drawing", type=File)
    parser.add_argument("--from", dest="start", type=_point, required=True, metavar="X,Y", help="millimetres")
    parser.add_argument("--to", dest="target", type=_point, required=True, metavar="X,Y", help="millimetres")
    parser.add_argument("--clearance", type=float, required=True, metavar="MM", help="tool radius plus margin")
    parser.add_argument("--unit", choices=("mm", "inch"), default="mm", help="of a file that names none")
    parser.add_argument("--output", type=File, metavar="FILE.svg", help="where the picture goes")
    parser.add_argument("--server", default="localhost:50051", metavar="HOST:PORT")
    parser.add_argument("--deadline", type=float, default=30.0, metavar="SECONDS")
    parser.add_argument("--ignore-unused", action="store_true", help="plan although parts of the drawing are not used")
    return parser.parse_args(_ends_joined(sys.argv[1:]))


def _ends_joined(words: list[str]) -> list[str]:
    """--from=-50,-50 for --from -50,-50: argparse takes what begins with a minus for an option."""
    joined: list[str] = []
    for word in words:
        if joined and joined[-1] in ("--from", "--to"):
            joined[-1] += f"={word}"
        else:
            joined.append(word)
    return joined


def _point(text: str) -> Point:
    x, y = text.split(",")
    return Point(float(x), float(y))


if __name__ == "__main__":
    sys.exit(main())

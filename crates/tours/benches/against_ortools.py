#!/usr/bin/env python3
"""Compares `traverse solve` with OR-Tools' routing search (guided local search) at equal time, on TSPLIB files.

    pip install ortools
    cargo build --release
    crates/tours/benches/against_ortools.py --time 10 FILE.atsp … [--binary target/release/traverse] [--optima optima.json]

Each file goes to both, one after the other, each on one thread for the same time. `traverse` may end earlier, when it has a
proof. Prints one row for each file, and how often each was better. Matrices have to be explicit and full (.atsp); .sop files
are not OR-Tools' kind of question as they stand and are passed over.
"""

from __future__ import annotations

import argparse
import json
import pathlib
import subprocess
import sys
import time


def read_matrix(path: pathlib.Path) -> list[list[int]]:
    """The weights of a TSPLIB file with a full explicit matrix."""
    head, _, tail = path.read_text().partition("EDGE_WEIGHT_SECTION")
    size = next(int(line.split(":")[1]) for line in head.splitlines() if line.startswith("DIMENSION"))
    numbers = [int(word) for word in tail.split("EOF")[0].split()]
    if len(numbers) != size * size:
        raise ValueError(f"{path}: {len(numbers)} weights for {size} nodes; only full matrices are read")
    return [numbers[row * size : (row + 1) * size] for row in range(size)]


def by_ortools(matrix: list[list[int]], seconds: float) -> tuple[int | None, float]:
    """Cost of the best tour that routing finds, and how long it worked."""
    from ortools.constraint_solver import pywrapcp, routing_enums_pb2

    manager = pywrapcp.RoutingIndexManager(len(matrix), 1, 0)
    routing = pywrapcp.RoutingModel(manager)

    def cost(start: int, end: int) -> int:
        return matrix[manager.IndexToNode(start)][manager.IndexToNode(end)]

    routing.SetArcCostEvaluatorOfAllVehicles(routing.RegisterTransitCallback(cost))
    parameters = pywrapcp.DefaultRoutingSearchParameters()
    parameters.first_solution_strategy = routing_enums_pb2.FirstSolutionStrategy.PATH_CHEAPEST_ARC
    parameters.local_search_metaheuristic = routing_enums_pb2.LocalSearchMetaheuristic.GUIDED_LOCAL_SEARCH
    parameters.time_limit.FromMilliseconds(int(1000 * seconds))
    began = time.monotonic()
    solution = routing.SolveWithParameters(parameters)
    took = time.monotonic() - began
    return (None if solution is None else solution.ObjectiveValue()), took


def by_traverse(binary: str, path: pathlib.Path, seconds: float) -> tuple[int | None, bool, float]:
    """Cost, whether it is proven, and how long it worked."""
    command = [binary, "solve", str(path), "--time-limit", f"{seconds}s"]
    answer = json.loads(subprocess.run(command, check=False, capture_output=True, text=True).stdout or "{}")
    return answer.get("cost"), bool(answer.get("proven")), float(answer.get("seconds", 0.0))


def excess(cost: int | None, best: int | None) -> str:
    """How much longer than the best that is known, in per cent."""
    if cost is None or not best:
        return "–"
    return f"{100 * (cost - best) / best:.2f} %"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("files", nargs="+", type=pathlib.Path)
    parser.add_argument("--time", type=float, default=10.0, help="seconds for each, default 10")
    parser.add_argument("--binary", default="target/release/traverse")
    parser.add_argument("--optima", type=pathlib.Path, help="JSON: name of the file without ending to its optimum")
    arguments = parser.parse_args()
    optima = json.loads(arguments.optima.read_text()) if arguments.optima else {}

    print("| instance | nodes | traverse | proven | seconds | above the best | OR-Tools | seconds | above the best |")
    print("|---|---:|---:|---|---:|---:|---:|---:|---:|")
    better = worse = equal = 0
    for path in (file for file in arguments.files if file.suffix != ".sop"):
        matrix = read_matrix(path)
        cost, proven, seconds = by_traverse(arguments.binary, path, arguments.time)
        other, other_seconds = by_ortools(matrix, arguments.time)
        known = optima.get(path.stem)
        best = known if isinstance(known, int) else min((c for c in (cost, other) if c is not None), default=None)
        print(
            f"| {path.stem} | {len(matrix)} | {cost} | {'yes' if proven else 'no'} | {seconds:.2f} | {excess(cost, best)} "
            f"| {other} | {other_seconds:.2f} | {excess(other, best)} |",
            flush=True,
        )
        ours, theirs = (float("inf") if value is None else value for value in (cost, other))
        better, worse, equal = better + (ours < theirs), worse + (ours > theirs), equal + (ours == theirs)
    print(f"\ntraverse better on {better}, equal on {equal}, worse on {worse}")
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())

"""Between this package's types and the messages of ``traverse.v1``: the only module that fills messages in."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import timedelta

from .answer import Check, Limits, NoPath, RapidPlan, Stats, ToolChangePlan, Violation
from .arc import Arc
from .effort import Algorithm, Effort
from .layout import Certificate, Layout, LayoutRules, PlacedSection, Pose, Section
from .path import Path, Step
from .point import Point
from .ring import Ring
from .scene import CornerStyle, Obstacle, Polygon, Scene
from .v1 import distances_pb2, geometry_pb2, rapid_pb2, sections_pb2, service_pb2, session_pb2, solve_pb2

_CORNER_STYLES = {CornerStyle.ROUND: rapid_pb2.CORNER_STYLE_ROUND, CornerStyle.MITER: rapid_pb2.CORNER_STYLE_MITER}
_ALGORITHMS = {
    Algorithm.EXACT: rapid_pb2.RAPID_ALGORITHM_EXACT,
    Algorithm.SUPPORTING_LINES: rapid_pb2.RAPID_ALGORITHM_SUPPORTING_LINES,
}

_POSES = {
    Pose.AS_IS: sections_pb2.SECTION_POSE_AS_IS,
    Pose.HALF_TURN: sections_pb2.SECTION_POSE_HALF_TURN,
    Pose.MIRROR_X: sections_pb2.SECTION_POSE_MIRROR_X,
    Pose.MIRROR_Y: sections_pb2.SECTION_POSE_MIRROR_Y,
}
_POSES_OF = {number: pose for pose, number in _POSES.items()}


def request_message(
    scene: Scene, start: tuple[float, float], target: tuple[float, float], effort: Effort, validate_only: bool = False
) -> rapid_pb2.PlanRapidMoveRequest:
    """A request for a rapid move."""
    request = rapid_pb2.PlanRapidMoveRequest(
        scene=scene_message(scene), start=_point(start), target=_point(target), validate_only=validate_only
    )
    request.rules.CopyFrom(_rules(effort))
    return request


def distances_message(
    scene: Scene, sources: Iterable[tuple[float, float]], targets: Iterable[tuple[float, float]], effort: Effort
) -> distances_pb2.PlanDistancesRequest:
    """A request for shortest costs from points to points."""
    return distances_pb2.PlanDistancesRequest(
        scene=scene_message(scene),
        from_xy_mm=(number for point in sources for number in point),
        to_xy_mm=(number for point in targets for number in point),
        rules=_rules(effort),
    )


def tool_change_message(
    scene: Scene,
    start: tuple[float, float],
    target: tuple[float, float],
    regions: Iterable[Ring | Polygon],
    points: Iterable[tuple[float, float]],
    effort: Effort,
) -> rapid_pb2.PlaceToolChangeRequest:
    """A request for the best place of a tool change."""
    shapes = (region if isinstance(region, Polygon) else Polygon(region) for region in regions)
    return rapid_pb2.PlaceToolChangeRequest(
        scene=scene_message(scene),
        start=_point(start),
        target=_point(target),
        regions=(_polygon(shape) for shape in shapes),
        points=(_point(point) for point in points),
        rules=_rules(effort),
    )


def scene_step(scene: Scene) -> session_pb2.PlanRapidMovesRequest:
    """The first step of a session."""
    return session_pb2.PlanRapidMovesRequest(scene=scene_message(scene))


def query_step(
    start: tuple[float, float], target: tuple[float, float], effort: Effort
) -> session_pb2.PlanRapidMovesRequest:
    """A move of a session."""
    query = session_pb2.RapidQuery(start=_point(start), target=_point(target), rules=_rules(effort))
    return session_pb2.PlanRapidMovesRequest(query=query)


def edit_step(put: Iterable[Obstacle], remove: Iterable[str]) -> session_pb2.PlanRapidMovesRequest:
    """A change of a session's scene."""
    edit = session_pb2.EditScene(put_obstacles=(_obstacle(obstacle) for obstacle in put), remove_obstacle_ids=remove)
    return session_pb2.PlanRapidMovesRequest(edit=edit)


def _rules(effort: Effort) -> rapid_pb2.RapidRules:
    rules = rapid_pb2.RapidRules(algorithm=_ALGORITHMS[effort.algorithm])
    if effort.time_limit is not None:
        rules.options.time_limit.FromTimedelta(effort.time_limit)
    rules.options.iteration_limit = effort.iteration_limit
    return rules


def order_message(
    sections: Iterable[Section], rules: LayoutRules, time_limit: timedelta | None
) -> sections_pb2.OrderSectionsRequest:
    """A request for an order of sections."""
    request = sections_pb2.OrderSectionsRequest(
        gap_mm=rules.gap_mm,
        strip_height_mm=rules.strip_height_mm,
        first_section_id=rules.first,
        last_section_id=rules.last,
        slide_rule=sections_pb2.SLIDE_RULE_FREE if rules.may_tuck_in else sections_pb2.SLIDE_RULE_KEEP_ORDER,
    )
    for section in sections:
        added = request.sections.add(
            id=section.id, quantity=section.quantity, allowed_poses=(_POSES[pose] for pose in section.poses)
        )
        for number, part in enumerate(section.parts, start=1):
            added.parts.add(id=str(number), shape=_polygon(part))
    for before, after in rules.precedences:
        request.precedences.add(before_section_id=before, after_section_id=after)
    for left, right in rules.forbidden_joins:
        request.forbidden_joins.add(left_section_id=left, right_section_id=right)
    if time_limit is not None:
        request.options.time_limit.FromTimedelta(time_limit)
    request.options.return_certificate = True
    return request


def layout(message: sections_pb2.OrderSectionsResponse) -> Layout:
    """What came of a request for an order of sections."""
    order = (
        PlacedSection(each.section_id, each.copy, _POSES_OF[each.pose], each.x_mm, each.y_mm) for each in message.order
    )
    return Layout(
        tuple(order),
        message.length_mm,
        message.bounding_box_length_mm,
        message.report.lower_bound,
        message.report.proven_optimal,
        message.report.solve_duration.ToTimedelta(),
        _certificate(message.report),
    )


def _certificate(report: solve_pb2.SolveReport) -> Certificate | None:
    if not report.HasField("certificate"):
        return None
    return Certificate(report.certified_lower_bound, report.certificate.SerializeToString())


def check_layout_message(
    request: sections_pb2.OrderSectionsRequest,
    order: Iterable[PlacedSection],
    tolerance_mm: float | None,
    certificate: Certificate | None,
) -> sections_pb2.CheckSectionsRequest:
    """A layout to check."""
    message = sections_pb2.CheckSectionsRequest(request=request, tolerance_mm=tolerance_mm)
    for each in order:
        message.order.add(
            section_id=each.section_id, copy=each.copy, pose=_POSES[each.pose], x_mm=each.x_mm, y_mm=each.y_mm
        )
    if certificate is not None:
        message.certificate.ParseFromString(certificate.encoded)
        message.claimed_lower_bound_mm = certificate.lower_bound_mm
    return message


def scene_message(scene: Scene) -> rapid_pb2.Scene:
    """A scene. What is None stays absent."""
    message = rapid_pb2.Scene(
        clearance_mm=scene.clearance_mm,
        corner_style=_CORNER_STYLES[scene.corner_style],
        work_area_clearance_mm=scene.work_area_clearance_mm,
        miter_limit=scene.miter_limit,
    )
    if scene.work_area_polygon is not None:
        message.work_area.CopyFrom(_polygon(scene.work_area_polygon))
    for obstacle in scene.obstacles:
        message.obstacles.append(_obstacle(obstacle))
    return message


def _obstacle(obstacle: Obstacle) -> rapid_pb2.Obstacle:
    return rapid_pb2.Obstacle(id=obstacle.id, shape=_polygon(obstacle.polygon), clearance_mm=obstacle.clearance_mm)


def path_message(path: Path) -> geometry_pb2.Path:
    """A path to check."""
    message = geometry_pb2.Path(start=_point(path.start))
    for step in path.steps:
        added = message.steps.add(end=_point(step.end))
        if step.arc is not None:
            arc = geometry_pb2.Arc(
                center=_point(step.arc.center), clockwise=step.arc.clockwise, sweep_rad=step.arc.sweep_rad
            )
            added.arc.CopyFrom(arc)
    return message


def outcome(
    scene: Scene, start: tuple[float, float], target: tuple[float, float], message: rapid_pb2.PlanRapidMoveResponse
) -> RapidPlan | NoPath:
    """What came of a request for a rapid move."""
    return step_outcome(scene, Point(*start), Point(*target), message)


def step_outcome(
    scene: Scene,
    start: Point,
    target: Point,
    message: rapid_pb2.PlanRapidMoveResponse | session_pb2.PlanRapidMovesResponse,
) -> RapidPlan | NoPath:
    """What came of a move, asked for alone or in a session."""
    stats = _stats(message.stats)
    kind = message.WhichOneof("outcome")
    if kind == "no_path":
        return NoPath(scene, start, target, tuple(message.no_path.separating_obstacle_ids), stats)
    if kind != "plan":
        raise NotImplementedError("the server answered with an outcome that this client does not know: update it")
    return _plan(scene, message.plan, stats)


def _plan(scene: Scene, plan: rapid_pb2.RapidPlan, stats: Stats) -> RapidPlan:
    return RapidPlan(
        scene,
        _path_of(plan.path),
        plan.cost,
        plan.lower_bound,
        tuple(plan.bending_obstacle_ids),
        tuple(_path_of(each) for each in plan.alternatives),
        stats,
    )


def _stats(message: rapid_pb2.RapidStats) -> Stats:
    return Stats(
        message.barrier_vertex_count,
        message.expanded_node_count,
        message.prepare_duration.ToTimedelta(),
        message.search_duration.ToTimedelta(),
    )


def tool_change(
    scene: Scene,
    start: tuple[float, float],
    target: tuple[float, float],
    message: rapid_pb2.PlaceToolChangeResponse,
) -> ToolChangePlan | NoPath:
    """What came of a request for the best place of a tool change."""
    stats = _stats(message.stats)
    kind = message.WhichOneof("outcome")
    if kind == "no_path":
        separating = tuple(message.no_path.separating_obstacle_ids)
        return NoPath(scene, Point(*start), Point(*target), separating, stats)
    if kind != "plan":
        raise NotImplementedError("the server answered with an outcome that this client does not know: update it")
    plan = message.plan
    return ToolChangePlan(
        Point(plan.place.x_mm, plan.place.y_mm),
        _plan(scene, plan.approach, stats),
        _plan(scene, plan.departure, stats),
        plan.cost,
        plan.lower_bound,
    )


def check(message: rapid_pb2.CheckRapidMoveResponse) -> Check:
    """What the checker found of a path."""
    margin = message.smallest_margin_mm if message.HasField("smallest_margin_mm") else None
    return Check(_violations(message.violations), message.cost, margin)


def layout_check(message: sections_pb2.CheckSectionsResponse) -> Check:
    """What the checker found of a layout; its cost is the length."""
    margin = message.smallest_margin_mm if message.HasField("smallest_margin_mm") else None
    bound = message.certified_lower_bound_mm if message.HasField("certified_lower_bound_mm") else None
    return Check(_violations(message.violations), message.length_mm, margin, bound)


def _violations(messages: Iterable[solve_pb2.Violation]) -> tuple[Violation, ...]:
    return tuple(
        Violation(
            each.field,
            each.reason,
            each.message,
            each.amount,
            _point_of(each.at) if each.HasField("at") else None,
            each.obstacle_id,
        )
        for each in messages
    )


def limits(message: service_pb2.GetLimitsResponse) -> Limits:
    """What a server accepts."""
    return Limits(
        message.server_version,
        message.message_bytes,
        message.coordinate_mm,
        message.radius_mm,
        message.vertex_count,
        message.obstacle_count,
        message.step_count,
        message.queued_call_count,
        message.default_time_limit.ToTimedelta(),
        message.longest_time_limit.ToTimedelta(),
        message.section_count,
        message.part_count,
        message.join_count,
    )


def _point(point: tuple[float, float]) -> geometry_pb2.Point:
    return geometry_pb2.Point(x_mm=point[0], y_mm=point[1])


def _ring(ring: Ring) -> geometry_pb2.Ring:
    return geometry_pb2.Ring(xy_mm=(number for vertex in ring.vertices for number in vertex), bulges=ring.bulges)


def _polygon(polygon: Polygon) -> geometry_pb2.Polygon:
    return geometry_pb2.Polygon(outer=_ring(polygon.outer), holes=(_ring(hole) for hole in polygon.holes))


def _point_of(message: geometry_pb2.Point) -> Point:
    return Point(message.x_mm, message.y_mm)


def _path_of(message: geometry_pb2.Path) -> Path:
    return Path(_point_of(message.start), tuple(_step_of(step) for step in message.steps))


def _step_of(message: geometry_pb2.PathStep) -> Step:
    if not message.HasField("arc"):
        return Step(_point_of(message.end))
    arc = message.arc
    return Step(_point_of(message.end), Arc(_point_of(arc.center), arc.clockwise, arc.sweep_rad))

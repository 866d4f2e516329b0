"""From a gRPC status to an exception."""

from __future__ import annotations

import grpc
from google.protobuf import any_pb2
from google.protobuf.message import DecodeError
from google.rpc import error_details_pb2, status_pb2

from .error import CallFailed, Finding, RequestRefused, ServerBusy, ServerUnavailable, TimeOver
from .v1 import solve_pb2

_KINDS: dict[grpc.StatusCode, type[CallFailed]] = {
    grpc.StatusCode.INVALID_ARGUMENT: RequestRefused,
    grpc.StatusCode.DEADLINE_EXCEEDED: TimeOver,
    grpc.StatusCode.UNAVAILABLE: ServerUnavailable,
    grpc.StatusCode.RESOURCE_EXHAUSTED: ServerBusy,
}


def exception(error: grpc.RpcError) -> CallFailed:
    """What ``error`` says, with the reason and every finding that came along."""
    if not isinstance(error, grpc.Call):
        return CallFailed(grpc.StatusCode.UNKNOWN, str(error))
    info = error_details_pb2.ErrorInfo()
    request = error_details_pb2.BadRequest()
    retry = error_details_pb2.RetryInfo()
    for detail in _details(error):
        for message in (info, request, retry):
            detail.Unpack(message)
    findings = (Finding(each.field, each.reason, each.description) for each in request.field_violations)
    return _KINDS.get(error.code(), CallFailed)(
        error.code(),
        error.details() or "",
        info.reason,
        info.metadata,
        tuple(findings),
        retry.retry_delay.ToTimedelta() if retry.HasField("retry_delay") else None,
    )


def refusal(problem: solve_pb2.Problem) -> CallFailed:
    """Why an item of a larger call was refused."""
    code = next((code for code in grpc.StatusCode if code.value[0] == problem.code), grpc.StatusCode.UNKNOWN)
    findings = (Finding(each.field, each.reason, each.message) for each in problem.findings)
    return _KINDS.get(code, CallFailed)(code, problem.message, problem.reason, findings=tuple(findings))


def _details(call: grpc.Call) -> list[any_pb2.Any]:
    """The details of google.rpc.Status, which travel beside the status as a trailer."""
    status = status_pb2.Status()
    for key, value in call.trailing_metadata() or ():
        if key == "grpc-status-details-bin" and isinstance(value, bytes):
            try:
                status.ParseFromString(value)
            except DecodeError:
                return []
    return list(status.details)

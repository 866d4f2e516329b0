"""Calls that failed, as exceptions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import timedelta

import grpc


@dataclass(frozen=True)
class Finding:
    """One thing that is wrong with a request."""

    field: str
    """Into the request, such as ``scene.obstacles[2].shape.outer.xy_mm[7]``."""
    reason: str
    """For programs; docs/errors.md explains each."""
    description: str
    """For people."""


class CallFailed(Exception):
    """A call that can't be understood or served. Programs go by ``code`` and ``reason``, as in docs/errors.md."""

    def __init__(
        self,
        code: grpc.StatusCode,
        message: str,
        reason: str = "",
        metadata: Mapping[str, str] | None = None,
        findings: tuple[Finding, ...] = (),
        retry_after: timedelta | None = None,
    ) -> None:
        lines = [f"{code.name} {reason}: {message}" if reason else f"{code.name}: {message}"]
        lines += [f"  {finding.field}: {finding.description} ({finding.reason})" for finding in findings]
        super().__init__("\n".join(lines))
        self.code = code
        self.message = message
        self.reason = reason
        """UPPER_SNAKE_CASE; empty when something else than Traverse answered."""
        self.metadata = dict(metadata or {})
        """Figures that belong to the reason."""
        self.findings = findings
        """All that is wrong with the request, in its order."""
        self.retry_after = retry_after
        """When the server says that trying again helps."""


class RequestRefused(CallFailed):
    """The request is wrong: mend every finding and send it again. INVALID_ARGUMENT."""


class TimeOver(CallFailed):
    """No answer was proven in time. DEADLINE_EXCEEDED."""


class ServerUnavailable(CallFailed):
    """Nobody answers, or the server stops; the tries are used up. UNAVAILABLE."""


class ServerBusy(CallFailed):
    """A queue, size or iteration limit is used up; ``retry_after`` says when waiting helps. RESOURCE_EXHAUSTED."""

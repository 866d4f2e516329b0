"""When and how often a call is tried again."""

from __future__ import annotations

import random
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

import grpc

from .status import exception

_Answer = TypeVar("_Answer")


@dataclass(frozen=True)
class Retry:
    """Tries again on UNAVAILABLE, and where the server says when, such as with a full queue. Nothing else gets better
    by being repeated. Pauses double, with jitter, after what the server asks for."""

    tries: int = 5
    """How often at most; 1: never again."""
    first_pause: float = 0.1
    """Seconds."""
    longest_pause: float = 2.0
    """Seconds."""

    def __post_init__(self) -> None:
        if self.tries < 1:
            raise ValueError(f"tries is {self.tries}: at least 1")

    def run(self, call: Callable[[float], _Answer], deadline: float) -> _Answer:
        """``call`` with the seconds that are left of ``deadline``, until it answers; raises what it raised last."""
        end = time.monotonic() + deadline
        tried = 0
        while True:
            try:
                return call(max(end - time.monotonic(), 0.0))
            except grpc.RpcError as error:
                tried += 1
                failed = exception(error)
                asked = failed.retry_after
                again = failed.code is grpc.StatusCode.UNAVAILABLE or asked is not None
                pause = self.pause(tried) + (asked.total_seconds() if asked is not None else 0.0)
                if not again or tried >= self.tries or time.monotonic() + pause >= end:
                    raise
            time.sleep(pause)

    def pause(self, tried: int) -> float:
        """Seconds to wait after so many tries: with jitter, so that clients do not come back together."""
        return min(self.first_pause * 2.0 ** (tried - 1), self.longest_pause) * random.uniform(0.5, 1.0)

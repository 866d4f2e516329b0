"""Deadlines, and servers that go away and come up."""

import socket
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from datetime import timedelta

import grpc
import pytest
from conftest import Server
from google.rpc import error_details_pb2, status_pb2

from traverse import CallFailed, Client, RapidPlan, Retry, Scene, ServerBusy, ServerUnavailable, TimeOver

EMPTY = Scene(clearance_mm=1)
PATIENT = Retry(tries=1000, longest_pause=0.2)


def test_a_silent_server_costs_no_more_than_the_deadline() -> None:
    with socket.socket() as silent:
        silent.bind(("127.0.0.1", 0))
        silent.listen()
        with Client(f"127.0.0.1:{silent.getsockname()[1]}", deadline=0.3) as client:
            began = time.monotonic()
            with pytest.raises((TimeOver, ServerUnavailable)):
                client.plan_rapid_move(EMPTY, (0, 0), (3, 4))
            assert time.monotonic() - began < 5
            with pytest.raises((TimeOver, ServerUnavailable)):
                client.plan_rapid_move(EMPTY, (0, 0), (3, 4), deadline=0.1)


def test_tries_are_bounded(free_port: int) -> None:
    with Client(f"127.0.0.1:{free_port}", retry=Retry(tries=2, first_pause=0.01)) as client:
        with pytest.raises(ServerUnavailable) as failed:
            client.plan_rapid_move(EMPTY, (0, 0), (3, 4))
    assert failed.value.reason == ""


def test_a_server_that_comes_up_late_is_waited_for(free_port: int) -> None:
    address = f"http://127.0.0.1:{free_port}"
    with Client(address, retry=Retry(tries=1)) as impatient:
        with pytest.raises(ServerUnavailable):
            impatient.limits()
    with Client(address, deadline=60, retry=PATIENT) as client, ThreadPoolExecutor(1) as pool:
        call = pool.submit(client.plan_rapid_move, EMPTY, (0, 0), (3, 4))
        server = Server(free_port)
        try:
            assert isinstance(call.result(timeout=60), RapidPlan)
        finally:
            server.stop()


def test_a_client_outlives_its_server() -> None:
    server = Server()
    port = int(server.address.rpartition(":")[2])
    with Client(server.address, deadline=60, retry=PATIENT) as client:
        assert isinstance(client.plan_rapid_move(EMPTY, (0, 0), (3, 4)), RapidPlan)
        server.stop()
        with pytest.raises((ServerUnavailable, TimeOver)):
            client.plan_rapid_move(EMPTY, (0, 0), (3, 4), deadline=0.3)
        server = Server(port)
        try:
            assert isinstance(client.plan_rapid_move(EMPTY, (0, 0), (3, 4)), RapidPlan)
        finally:
            server.stop()


@pytest.mark.parametrize("code", [each for each in grpc.StatusCode if each is not grpc.StatusCode.OK])
def test_only_unavailable_is_tried_again(code: grpc.StatusCode) -> None:
    calls = Calls(code)
    with Client(calls.address, deadline=30, retry=Retry(tries=3, first_pause=0.001)) as client:
        with pytest.raises(CallFailed) as failed:
            client.limits()
    calls.stop()
    assert failed.value.code is code
    assert calls.count == (3 if code is grpc.StatusCode.UNAVAILABLE else 1)


def test_what_comes_with_a_delay_is_tried_again_after_it() -> None:
    calls = Calls(grpc.StatusCode.RESOURCE_EXHAUSTED, delay=timedelta(milliseconds=20))
    with Client(calls.address, deadline=30, retry=Retry(tries=3, first_pause=0.001)) as client:
        began = time.monotonic()
        with pytest.raises(ServerBusy) as failed:
            client.limits()
        assert time.monotonic() - began >= 0.04  # two pauses
        assert failed.value.retry_after == timedelta(milliseconds=20)
        assert calls.count == 3
    calls.stop()
    patient = Calls(grpc.StatusCode.RESOURCE_EXHAUSTED, delay=timedelta(hours=1))
    with Client(patient.address, deadline=30) as client, pytest.raises(ServerBusy):
        client.limits()  # at once: the delay is longer than the deadline
    assert patient.count == 1
    patient.stop()


def test_pauses_double_with_jitter_up_to_the_longest() -> None:
    retry = Retry(first_pause=0.1, longest_pause=0.3)
    for tried, most in ((1, 0.1), (2, 0.2), (3, 0.3), (9, 0.3)):
        pauses = {retry.pause(tried) for _ in range(100)}
        assert most / 2 <= min(pauses) < max(pauses) <= most
    with pytest.raises(ValueError, match="tries is 0"):
        Retry(tries=0)


class Calls(grpc.GenericRpcHandler):  # type: ignore[misc, unused-ignore]
    """A server that answers every call with one status and counts them."""

    def __init__(self, code: grpc.StatusCode, delay: timedelta | None = None) -> None:
        self.count = 0
        self._details = status_pb2.Status()
        if delay is not None:
            info = error_details_pb2.RetryInfo()
            info.retry_delay.FromTimedelta(delay)
            self._details.details.add().Pack(info)
        self._code = code
        self._lock = threading.Lock()
        self._server = grpc.server(ThreadPoolExecutor(1), handlers=[self])
        self.address = f"127.0.0.1:{self._server.add_insecure_port('127.0.0.1:0')}"
        self._server.start()

    def service(self, handler_call_details: object) -> "grpc.RpcMethodHandler[bytes, bytes]":
        return grpc.unary_unary_rpc_method_handler(self._answer)

    def _answer(self, request: bytes, context: grpc.ServicerContext) -> bytes:
        with self._lock:
            self.count += 1
        context.set_trailing_metadata((("grpc-status-details-bin", self._details.SerializeToString()),))
        context.abort(self._code, "as the test wants it")

    def stop(self) -> None:
        self._server.stop(None).wait()

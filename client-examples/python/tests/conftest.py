"""A live server for the tests: the binary that TRAVERSE_BINARY names."""

from __future__ import annotations

import os
import socket
import subprocess
from collections.abc import Iterator

import pytest

from traverse import Client


class Server:
    """A ``traverse serve`` of its own."""

    def __init__(self, port: int = 0) -> None:
        binary = os.environ.get("TRAVERSE_BINARY")
        if not binary:
            pytest.fail("set TRAVERSE_BINARY to the traverse binary")
        self._process = subprocess.Popen(
            [binary, "serve", "--listen", f"127.0.0.1:{port}"],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        assert self._process.stdout is not None
        # Printed once it listens: `traverse listens on http://127.0.0.1:PORT`.
        line = self._process.stdout.readline()
        if "http://" not in line:
            self.stop()
            pytest.fail(f"the server said {line!r} instead of its address")
        self.address = line.split()[-1]

    def stop(self) -> None:
        """Ends it and waits until it is gone."""
        self._process.terminate()
        self._process.wait(timeout=30)
        if self._process.stdout is not None:
            self._process.stdout.close()


@pytest.fixture(scope="session")
def address() -> Iterator[str]:
    """Of a server that all tests share."""
    server = Server()
    yield server.address
    server.stop()


@pytest.fixture
def client(address: str) -> Iterator[Client]:
    """Connected to it."""
    with Client(address, deadline=30) as connected:
        yield connected


@pytest.fixture
def free_port() -> int:
    """A port that nobody listens on."""
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        port: int = listener.getsockname()[1]
        return port

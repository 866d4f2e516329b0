"""Build hook: generates ``traverse.v1`` from the contract, into the wheel and not into the source tree."""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path
from typing import Any

from grpc_tools import protoc  # type: ignore[import-untyped]
from hatchling.builders.hooks.plugin.interface import BuildHookInterface


class GenerateMessages(BuildHookInterface):  # type: ignore[type-arg]
    """Runs protoc for every ``traverse/v1/*.proto``: of the clone, or of a source distribution's copy."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        if self.target_name != "wheel":
            return
        contract = self._contract()
        self._out = tempfile.mkdtemp(prefix="traverse-messages-")
        files = sorted(str(file) for file in contract.glob("traverse/v1/*.proto"))
        google = Path(protoc.__file__).parent / "_proto"
        code = protoc.main(
            ["protoc", f"-I{contract}", f"-I{google}", f"--python_out={self._out}", f"--pyi_out={self._out}", *files]
        )
        if code != 0:
            raise RuntimeError(f"protoc ended with {code} on {contract}")
        for file in sorted(Path(self._out).rglob("*_pb2.py*")):
            build_data["force_include"][str(file)] = file.relative_to(self._out).as_posix()

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        if self.target_name == "wheel":
            shutil.rmtree(self._out)

    def _contract(self) -> Path:
        root = Path(self.root)
        for folder in (root / "proto", root.parent.parent / "proto"):
            if any(folder.glob("traverse/v1/*.proto")):
                return folder
        raise RuntimeError("proto/traverse/v1 is missing: install from a clone or a source distribution")

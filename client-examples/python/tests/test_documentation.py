"""What the documentation shows, runs."""

import doctest
import re
from pathlib import Path as File

import pytest

import traverse
import traverse.layout
import traverse.path
import traverse.scene

README = File(__file__).parents[1] / "README.md"


def test_the_readme_runs(address: str, capsys: pytest.CaptureFixture[str]) -> None:
    (code,) = re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)
    names: dict[str, object] = {}
    exec(code.replace("localhost:50051", address), names)
    assert "not to be beaten" in capsys.readouterr().out
    outline = "Ring.from_path(Path.begin((0, 0)).line_to((40, 0)).arc_to((40, 20), center=(40, 10)).line_to((0, 20)))"
    assert outline in README.read_text(encoding="utf-8")
    assert eval(outline, vars(traverse)).length_mm == pytest.approx(40 + 31.41592653589793 + 40 + 20)


@pytest.mark.parametrize(
    "module", [traverse, traverse.layout, traverse.path, traverse.scene], ids=lambda module: module.__name__
)
def test_doc_strings_run(module: object) -> None:
    failed, tried = doctest.testmod(module)  # type: ignore[arg-type]
    assert (failed, tried > 0) == (0, True)

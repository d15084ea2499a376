"""The names of the package: sorted, all there, and known to a type checker, wrong ones too."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import windswept


def test_public_names_are_sorted_and_all_there() -> None:
    assert windswept.__all__ == sorted(windswept.__all__) == sorted(windswept._HOMES)
    for name in windswept.__all__:
        assert getattr(windswept, name).__name__ == name
    with pytest.raises(AttributeError, match="has no attribute 'gorw'"):
        windswept.gorw  # type: ignore[attr-defined]  # noqa: B018


@pytest.mark.slow
def test_a_type_checker_finds_a_wrong_name_and_a_wrong_argument(tmp_path: Path) -> None:
    probe = tmp_path / "probe.py"
    probe.write_text(
        'import windswept\nwindswept.gorw("hazel")\nwindswept.grow("hazel", seed="two")\n'
        + "".join(f"windswept.{name}\n" for name in windswept.__all__)
    )
    command = [sys.executable, "-m", "mypy", "--config-file", "pyproject.toml", "--follow-imports", "silent"]
    root = Path(windswept.__file__).parents[2]
    done = subprocess.run([*command, str(probe)], cwd=root, capture_output=True, text=True)
    errors = [line for line in done.stdout.splitlines() if "error:" in line]
    assert [line.split(":")[1] for line in errors] == ["2", "3"], done.stdout + done.stderr
    assert 'has no attribute "gorw"' in errors[0]
    assert 'expected "int"' in errors[1]

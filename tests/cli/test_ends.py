"""How a command ends that cannot go on: one line, an exit code, and nothing half done left behind."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from command_line import run
from windswept.cli import species
from windswept.forms.files import written_whole


def test_a_package_that_is_not_installed_is_named(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def wants_more(_name: str) -> None:
        import mujoco  # noqa: F401

    monkeypatch.setitem(sys.modules, "mujoco", None)
    monkeypatch.setattr(species, "load_species", wants_more)
    assert run("species") == 2
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err == (
        "windswept: this needs the package mujoco, which is not installed: pip install mujoco\n"
    )


def test_a_part_of_windswept_that_is_missing_is_a_bug(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "windswept.cli.species", None)
    with pytest.raises(ModuleNotFoundError):
        run("species")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="needs a device that takes nothing")
def test_a_full_disk_is_one_line() -> None:
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "windswept", "species"], stdout=full, stderr=subprocess.PIPE, text=True
        )
    assert done.returncode == 2
    assert done.stderr == "windswept: the output cannot be written (No space left on device)\n"


def test_being_told_to_end_leaves_no_half_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def works_for_long(_name: str) -> None:
        with written_whole(tmp_path / "x.mp4") as partial:
            partial.write_bytes(b"half")
            os.kill(os.getpid(), signal.SIGTERM)
            time.sleep(30.0)

    before = signal.getsignal(signal.SIGTERM)
    monkeypatch.setattr(species, "load_species", works_for_long)
    assert run("species") == 130
    assert capsys.readouterr().err.strip() == "windswept: stopped"
    assert list(tmp_path.iterdir()) == []
    assert signal.getsignal(signal.SIGTERM) is before

"""The command line, driven as a person would: output, exit codes, one line for every mistake."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from PIL import Image

from command_line import run, write_scene
from windswept.cli import COMMANDS, doctor
from windswept.gpu.device import TIMESTAMPS, shared_device
from windswept.plants.underbrush import underbrush_names


@pytest.fixture
def small_scene(tmp_path: Path) -> Path:
    return write_scene(tmp_path)


def test_help_lists_every_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert run() == 0
    listed = capsys.readouterr().out
    assert all(f"  {name} " in listed for name in COMMANDS)


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_has_help_with_an_example(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(name, "--help") == 0
    assert f"Example: windswept {name}" in " ".join(capsys.readouterr().out.split())


def test_grow_reports_the_stated_fields(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("grow", "hazel", "--seed", 2, "--json") == 0
    figures = json.loads(capsys.readouterr().out)
    stated = ["species", "seed", "height_m", "crown_radius_m", "dbh_m", "stems", "links", "leaves"]
    stated += ["leaf_area_m2", "wood_mass_kg", "frequencies_hz", "seconds"]
    assert [key for key in stated if key not in figures] == []
    assert figures["seed"] == 2
    assert figures["links"] > sum(figures["stems"])
    assert len(figures["frequencies_hz"]) == 5
    assert figures["frequencies_hz"] == sorted(figures["frequencies_hz"])


def test_species_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("species", "--json") == 0
    names = [one["name"] for one in json.loads(capsys.readouterr().out)]
    assert {"quaking_aspen", "black_tupelo", "weeping_willow", "california_black_oak"} <= set(names)


def test_underbrush_is_marked_where_species_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("species", "--json") == 0
    marked = {one["name"] for one in json.loads(capsys.readouterr().out) if one["underbrush"]}
    assert marked == set(underbrush_names())
    assert run("species") == 0
    lines = capsys.readouterr().out.splitlines()
    assert {line.split()[0] for line in lines if line.split()[1] == "underbrush,"} == marked


def test_a_sheet_says_what_is_not_on_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("windswept.studies.species_sheet.draw_sheet", lambda *_, **__: None)
    assert run("species", "--sheet", tmp_path / "sheet.png") == 0
    said = capsys.readouterr().err
    assert all(name in said for name in underbrush_names())


def test_reproduce_makes_the_folder_that_it_is_given(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("windswept.studies.endo.endo", lambda folder, say: [])
    folder = tmp_path / "new" / "pictures"
    assert run("reproduce", "endo", "-o", folder, "--json") == 0
    assert folder.is_dir()
    said = capsys.readouterr()
    assert (said.out, said.err) == ("[]\n", f"wrote pictures into {folder}\n")
    (tmp_path / "file").write_text("")
    for place in (tmp_path / "file", tmp_path / "file" / "pictures"):
        assert run("reproduce", "endo", "-o", place) == 2
        said = f"windswept: --output = '{place}': expected a folder, not a file\n"
        assert capsys.readouterr().err == said


def test_levels_reports_every_level(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("levels", "hazel", "--seconds", 1, "--json") == 0
    report = json.loads(capsys.readouterr().out)
    links = [row["links"] for row in report["levels"]]
    assert links == sorted(links, reverse=True)
    assert report["levels"][0]["measured_max_m"] == 0.0
    assert {
        "level",
        "links",
        "bound_m",
        "measured_p95_m",
        "measured_max_m",
        "distance_m",
        "ns_per_step",
    } <= set(report["levels"][0])
    assert report["bytes_plant"] > 0


def test_render_draws_a_picture_and_a_video(
    small_scene: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    picture, video = tmp_path / "a.png", tmp_path / "a.mp4"
    assert run("render", small_scene, "-o", picture, "--size", "96x64", "--json") == 0
    assert json.loads(capsys.readouterr().out)["plants"] == 1  # nothing else is on stdout
    with Image.open(picture) as image:
        assert image.size == (96, 64)
    assert run("render", small_scene, "-o", video, "--size", "96x64") == 0
    said = capsys.readouterr()
    assert said.out == f"wrote {video}\n"
    assert "drawing a.mp4" in said.err.splitlines()
    assert "" not in said.err.splitlines()
    assert video.stat().st_size > 500
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.mp4", "a.png", "small.toml"]


def test_doctor_names_the_adapter(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("doctor", "--json") == 0
    report = json.loads(capsys.readouterr().out)
    assert report["adapter"]
    assert report["mend"] is None
    limits = shared_device().limits
    assert report["limits"] == {
        "binds_bytes": limits["max-storage-buffer-binding-size"],
        "buffer_bytes": limits["max-buffer-size"],
        "has_clock": TIMESTAMPS in shared_device().features,
    }


@pytest.mark.parametrize(
    ("limits", "line"),
    [
        ((2**27, 2**31 - 1, True), "128 MiB of a buffer, which may have 2.0 GiB; a clock for stages"),
        ((2**30, 2**30, False), "1.0 GiB of a buffer, which may have 1.0 GiB; no clock: no stage is timed"),
    ],
)
def test_doctor_says_how_much_the_adapter_takes(
    limits: tuple[int, int, bool],
    line: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    named = dict(zip(("binds_bytes", "buffer_bytes", "has_clock"), limits, strict=True))
    monkeypatch.setattr(doctor, "find_adapter", lambda: ("a card", named))
    assert run("doctor") == 0
    assert f"limits    shaders see {line}\n" in capsys.readouterr().out


def test_doctor_without_an_adapter_names_its_mend_alone(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(doctor, "find_adapter", lambda: None)
    assert run("doctor") == 2
    said = capsys.readouterr().out
    assert "adapter   none" in said
    assert "mend      as root: " in said
    assert "limits" not in said


@pytest.mark.parametrize(
    "arguments",
    [
        ("grow", "no_such_species"),
        ("grow", "missing.toml"),
        ("grow", "hazel", "--seed", "-1"),
        ("render", "hazel", "-o", "x.gif"),
        ("render", "hazel", "-o", "no/such/folder/x.png"),
        ("render", "hazel", "-o", "x.png", "--size", "0x0"),
        ("render", "hazel", "-o", "x.png", "--size", "big"),
        ("render", "no_such_scene", "-o", "x.png"),
        ("render", "hazel", "-o", "."),
        ("render", "hazel", "-o", "/proc/x.png"),
        ("render", "hazel", "-o", "x.png", "--at", "nan"),
        ("render", "hazel", "-o", "x.mp4", "--duration", "nan"),
        ("render", "hazel", "-o", "x.mp4", "--seed", "2147483648"),
        ("render", "hazel", "-o", "x.png", "--duration", "3"),
        ("render", "hazel", "-o", "x.mp4", "--at", "3"),
        ("render", "hazel", "-o", ""),
        ("grow", "hazel", "--leaf-area", "5"),
        ("grow", "common_poppy"),
        ("reproduce", "endo", "--links", "5000"),
        ("reproduce", "beaudoin", "-o", "/proc/pictures", "--links", "1000"),
        ("levels", "hazel", "--seconds", "nan"),
        ("levels", "hazel", "--seed", "2147483648"),
        ("species", "--sheet", "no/folder/x.png"),
        ("species", "--sheet", "x.bmp"),
        ("view", "no_such_scene"),
        ("bench", "nothing"),
        ("nonsense",),
    ],
)
def test_a_mistake_is_one_line_and_exit_code_2(
    arguments: tuple[str, ...],
    capsys: pytest.CaptureFixture[str],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(*arguments) == 2
    output = capsys.readouterr()
    assert output.out == ""
    assert len(output.err.strip().splitlines()) == 1
    assert not list(tmp_path.iterdir())


def test_a_window_without_a_display_is_one_line(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    assert run("view", "hazel") == 2
    assert "no display" in capsys.readouterr().err


def test_importing_windswept_loads_nothing_heavy() -> None:
    import subprocess
    import sys

    code = (
        "import sys, windswept; heavy = {'wgpu', 'numba', 'scipy', 'av', 'PIL', 'rendercanvas', 'mujoco'}; "
        "print(sorted(heavy & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_levels_are_drawn_and_have_errors_in_the_metrics_unit(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    picture = tmp_path / "levels.png"
    assert run("levels", "hazel", "--seconds", 1, "--metric", "velocity", "--plot", picture, "--json") == 0
    report = json.loads(capsys.readouterr().out)
    assert report["unit"] == "m/s"
    assert report["levels"][1]["bound_m_s"] >= report["levels"][1]["measured_p95_m_s"] > 0.0
    assert report["levels"][1]["distance_m"] is None
    assert picture.stat().st_size > 5_000


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (
            ("render", "hazel", "-o", "x.gif"),
            "--output = 'x.gif': expected a path that ends in .png, .mp4 or",
        ),
        (("render", "hazel", "-o", "/no/x.png"), "--output = '/no/x.png': expected a folder that exists"),
        (("render", "hazel", "-o", "x.png", "--duration", "3"), "--duration = 3.0: expected a video"),
        (("render", "hazel", "-o", "x.mp4", "--at", "3"), "--at = 3.0: expected a picture"),
        (("levels", "hazel", "--plot", "x.gif"), "--plot = 'x.gif': expected a path that ends in .png"),
        (("species", "--sheet", "x.bmp"), "--sheet = 'x.bmp': expected a path that ends in .png"),
        (("reproduce", "endo", "--links", "5000"), "--links = 5000: expected beaudoin as the paper"),
        (("reproduce", "endo", "-o", ""), "--output = '': expected the path of a folder"),
    ],
)
def test_the_option_at_fault_is_named(
    arguments: tuple[str, ...], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(*arguments) == 2
    assert capsys.readouterr().err.startswith(f"windswept: {said}")

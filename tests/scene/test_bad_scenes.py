"""Every mistake in a scene file is one line with file, place, value and what was expected."""

import math
from pathlib import Path
from typing import Any

import pytest

from windswept.errors import BudgetError, InputError
from windswept.scene.load_scene import build_scene, load_scene

CAMERA = {"eye": [0.0, -30.0, 2.0], "target": [0.0, 0.0, 6.0]}
PLANT = {"source": "hazel", "position": [0.0, 0.0]}
STAND = {"count": 5, "area": {"rectangle": [-9.0, -9.0, 9.0, 9.0]}, "source": [{"source": "hazel"}]}
GOOD: dict[str, Any] = {"plant": [PLANT], "camera": CAMERA}
WAVE = {"wavelength_m": 9.0, "speed_m_s": 3.0, "amplitude_m_s": 1.0}

BAD = {
    "unknown key": ({"sede": 3}, "sede: expected a known key: did you mean seed?"),
    "unknown key, deep": (
        {"stand": [STAND | {"cuont": 3}]},
        "stand[0].cuont: expected a known key: did you mean count?",
    ),
    "missing key": (
        {"plant": [{"source": "hazel"}]},
        "plant[0].position: expected this key to be given: two num",
    ),
    "wrong type": ({"seed": "three"}, "seed = 'three': expected a whole number from 0 to 2,147,483,647"),
    "empty source": (
        {"plant": [PLANT | {"source": ""}]},
        "plant[0].source = '': expected text of 1 to 1,000 characters",
    ),
    "truth is no number": ({"ground": {"size_m": True}}, "ground.size_m = true: expected a number from 10"),
    "not a table": ({"wind": 3}, "wind = 3: expected a table"),
    "negative length": (
        {"ground": {"size_m": -5.0}},
        "ground.size_m = -5.0: expected a number from 10 to 4,000",
    ),
    "not a number": (
        {"wind": {"speed_m_s": math.nan}},
        "wind.speed_m_s = nan: expected a number from 0 to 60",
    ),
    "infinite": (
        {"time": {"duration_s": math.inf}},
        "time.duration_s = inf: expected a number above 0 to 3,600",
    ),
    "unknown choice": ({"ground": {"kind": "sea"}}, 'ground.kind = \'sea\': expected one of "flat", "hills"'),
    "short position": ({"plant": [PLANT | {"position": [1.0]}]}, "plant[0].position[1]: expected this key"),
    "no plants": ({"plant": []}, "test.toml: expected at least one [[plant]] or [[stand]], or a [spread]"),
    "no count": ({"stand": [STAND | {"count": 0}]}, "stand[0].count = 0: expected a whole number from 1"),
    "unknown species": (
        {"plant": [PLANT | {"source": "hazle"}]},
        "plant[0].source = 'hazle': expected a built-in species, underbrush or grammar, or a file: did you mean "
        "hazel?",
    ),
    "missing plant source": (
        {"stand": [STAND | {"source": [{"source": "no/such.npz"}]}]},
        "stand[0].source[0].source = 'no/such.npz': expected a file that exists (looked for ",
    ),
    "waves too short to travel": (
        {"wind": {"waves": [WAVE | {"wavelength_m": 1e-300}]}},
        "wind.waves[0].wavelength_m = 1e-300: expected a number from 0.1 to 10,000",
    ),
    "off the ground": ({"plant": [PLANT | {"position": [0.0, 150.0]}]}, "expected x and y from -100 to 100"),
    "area off the ground": (
        {"stand": [STAND | {"area": {"ellipse": [90.0, 0.0, 20.0, 5.0]}}]},
        "stand[0].area.ellipse = [110.0, ",
    ),
    "two shapes": (
        {"stand": [STAND | {"area": {"rectangle": [0, 0, 1, 1], "ellipse": [0, 0, 1, 1]}}]},
        "stand[0].area = ['rectangle', 'ellipse']: expected exactly one of rectangle, ellipse, polygon",
    ),
    "no shape": ({"stand": [STAND | {"area": {}}]}, "stand[0].area = []: expected exactly one of"),
    "upside down": (
        {"stand": [STAND | {"area": {"rectangle": [0, 5, 9, 1]}}]},
        "stand[0].area.rectangle = [0.0, 5.0, 9.0, 1.0]: expected west below east and south below north",
    ),
    "no radius": ({"stand": [STAND | {"area": {"ellipse": [0, 0, 5, 0]}}]}, "expected radii above 0"),
    "two corners": (
        {"stand": [STAND | {"area": {"polygon": [[0, 0], [1, 1]]}}]},
        "expected 3 to 1,000 lists of two",
    ),
    "no inside": (
        {"stand": [STAND | {"area": {"polygon": [[0, 0], [9, 9], [4, 4]]}}]},
        "stand[0].area.polygon: expected corners around a piece of ground",
    ),
    "crowded": (
        {"stand": [STAND | {"count": 900}]},
        "stand[0].count = 900: expected at most ",
    ),
    "canopy above the reference": (
        {"wind": {"displacement_m": 8.0, "roughness_m": 1.0}},
        "wind.displacement_m = 8.0: expected a number below 7.28 with roughness_m = 1",
    ),
    "printed power": (
        {"wind": {"waves": [WAVE | {"form": "as_printed", "power": 1.5}]}},
        "wind.waves[0].power = 1.5: expected a whole number",
    ),
    "waves end first": (
        {"wind": {"waves": [WAVE | {"start_s": 5.0, "end_s": 4.0}]}},
        "expected a time after start_s",
    ),
    "no camera": ({"camera": {}}, "camera.eye: expected this key to be given, or [[camera.key]] instead"),
    "half a camera": ({"camera": {"eye": [0, 0, 1]}}, "camera.target: expected this key to be given"),
    "both cameras": (
        {"camera": CAMERA | {"key": [CAMERA | {"time_s": 0.0}]}},
        "expected either keys or eye and",
    ),
    "keys out of order": (
        {"camera": {"key": [CAMERA | {"time_s": 4.0}, CAMERA | {"time_s": 4.0}]}},
        "camera.key[1].time_s = 4.0: expected a time after 4",
    ),
    "eye in target": (
        {"camera": {"eye": [1, 2, 3], "target": [1, 2, 3]}},
        "camera.target = [1.0, 2.0, 3.0]: expected a place other than the eye",
    ),
}


@pytest.mark.parametrize("name", BAD)
def test_mistake_is_told_in_one_line(name: str) -> None:
    change, message = BAD[name]
    with pytest.raises(InputError) as caught:
        build_scene("test.toml", GOOD | change)
    text = str(caught.value)
    assert message in text
    assert text.startswith("test.toml")
    assert "\n" not in text
    assert len(text) < 300


def test_crowded_stand_says_how_many_fit_and_that_many_do() -> None:
    with pytest.raises(InputError) as caught:
        build_scene("test.toml", GOOD | {"stand": [STAND | {"count": 900}]})
    fit = int(caught.value.expected.split()[2].rstrip(","))
    assert 15 < fit < 40
    build_scene("test.toml", GOOD | {"stand": [STAND | {"count": fit}]})


def test_crowded_mixture_counts_what_fits_in_its_ratio() -> None:
    # Wide oaks fill up first; the hazels between them must not hide that.
    sources = [{"source": "california_black_oak", "spacing_m": 9.0}, {"source": "hazel", "spacing_m": 0.5}]
    with pytest.raises(InputError) as caught:
        build_scene("test.toml", GOOD | {"stand": [STAND | {"count": 60, "source": sources}]})
    fit = int(caught.value.expected.split()[2].rstrip(","))
    assert fit < 20
    build_scene("test.toml", GOOD | {"stand": [STAND | {"count": fit, "source": sources}]})


def test_too_many_plants_name_the_count_and_what_to_lower() -> None:
    stands = [STAND, STAND | {"count": 60_000}]
    with pytest.raises(BudgetError, match=r"60,006 plants, at most 50,000: lower stand\[1\].count"):
        build_scene("test.toml", GOOD | {"stand": stands})


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"seed = 1\nwind = [\n", "line 3: expected valid TOML"),
        (b"seed = 1\nseed = 2\n", "line 2: expected valid TOML (Cannot overwrite a value)"),
        (b"seed = 1\n\xff", "byte 9: expected UTF-8 text"),
        (b"", "camera: expected this key to be given: a table"),
    ],
)
def test_bad_files(tmp_path: Path, content: bytes, message: str) -> None:
    path = tmp_path / "bad.toml"
    path.write_bytes(content)
    with pytest.raises(InputError) as caught:
        load_scene(path)
    assert message in str(caught.value)
    assert str(caught.value).startswith(str(path))


def test_missing_file_directory_and_unknown_name(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="expected a file that exists"):
        load_scene(tmp_path / "none.toml")
    with pytest.raises(InputError, match="not a directory"):
        load_scene(tmp_path)
    with pytest.raises(InputError, match="did you mean quaking_aspen"):
        load_scene("quaking_aspn")
    with pytest.raises(InputError, match="a scene file, or a plant's name or file"):
        load_scene("")
    with pytest.raises(InputError, match="did you mean common_poppy"):
        load_scene("common_popy")
    with pytest.raises(InputError, match="source: expected the path of a scene file, or the name of a plant"):
        load_scene(None)  # type: ignore[arg-type]


@pytest.mark.parametrize("seed", [1.5, -1, True, "two"])
def test_a_seed_is_a_whole_number(seed: Any) -> None:
    for source in ("hazel", "common_poppy"):
        with pytest.raises(InputError, match=r"seed = .*: expected a whole number from 0 up"):
            load_scene(source, seed)


def test_a_byte_order_mark_is_no_mistake(tmp_path: Path) -> None:
    path = tmp_path / "notepad.toml"
    text = '[[plant]]\nsource = "hazel"\nposition = [0, 0]\n[camera]\neye = [0, -9, 1]\ntarget = [0, 0, 1]\n'
    path.write_bytes(b"\xef\xbb\xbf" + text.encode())
    assert load_scene(path).placement_count == 1


def test_a_camera_in_the_ground_is_told_how_high_that_is() -> None:
    hills = {"ground": {"kind": "hills", "relief_m": 20.0}, "camera": CAMERA | {"eye": [0.0, -30.0, -0.1]}}
    with pytest.raises(
        InputError, match=r"camera\.eye = \[0.0, -30.0, -0.1\]: expected a height above the ground"
    ):
        build_scene("test.toml", GOOD | hills)
    keys = [CAMERA | {"time_s": 0.0}, {"time_s": 1.0, "eye": [0.0, 9.0, -5.0], "target": [0.0, 0.0, 1.0]}]
    with pytest.raises(InputError, match=r"camera\.key\[1\]\.eye"):
        build_scene("test.toml", GOOD | {"camera": {"key": keys}})
    build_scene("test.toml", GOOD | {"camera": CAMERA | {"eye": [0.0, -30.0, 0.0]}})


def test_a_folder_is_no_image_and_no_plant(tmp_path: Path) -> None:
    scene = str(tmp_path / "scene.toml")
    with pytest.raises(InputError, match=r"image = '\.': expected an image, not a folder"):
        build_scene(scene, GOOD | {"ground": {"kind": "image", "image": "."}})
    with pytest.raises(InputError, match=r"source = '\./': expected a file, not a folder"):
        build_scene(scene, GOOD | {"plant": [PLANT | {"source": "./"}]})


def test_faulty_species_file_names_itself(tmp_path: Path) -> None:
    (tmp_path / "own.toml").write_text("name = 3")
    with pytest.raises(InputError, match=r"own\.toml: name = 3"):
        build_scene(str(tmp_path / "scene.toml"), GOOD | {"plant": [PLANT | {"source": "own.toml"}]})

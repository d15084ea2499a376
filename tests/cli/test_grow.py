"""windswept grow: figures, import reports, saving, one line for every mistake."""

import json

import pytest

from windswept.cli import main
from windswept.plants.sources import grow_source

PRESET = "<arbaro><species name='twig'>{}</species></arbaro>".format(
    "".join(
        f"<param name='{name}' value='{value}'/>"
        for name, value in {"Scale": 4, "Levels": 2, "1Branches": 8, "Flare": -1, "Smooth": 0.5}.items()
    )
)


@pytest.fixture
def preset(tmp_path):
    path = tmp_path / "twig.xml"
    path.write_text(PRESET)
    return path


def figures(capsys, *arguments):
    main(["grow", *map(str, arguments), "--json"])
    return json.loads(capsys.readouterr().out)


def test_a_species(capsys) -> None:
    found = figures(capsys, "hazel", "--seed", 3)
    assert found["species"] == "hazel"
    assert found["seed"] == 3
    assert "import_report" not in found
    assert len(found["frequencies_hz"]) == 5


def test_a_preset_reports_on_stderr_and_in_json(capsys, preset) -> None:
    main(["grow", str(preset), "--json"])
    out, err = capsys.readouterr()
    report = json.loads(out)["import_report"]
    assert report["format"] == "Arbaro XML"
    assert report["clamped"] == ["Flare -1 -> 0"]
    assert report["without_counterpart"] == ["Smooth"]
    assert "clamped: Flare -1 -> 0" in err


@pytest.mark.parametrize("ending", ["npz", "toml"])
def test_what_is_saved_grows_the_same(capsys, preset, tmp_path, ending) -> None:
    saved = tmp_path / f"saved.{ending}"
    figures(capsys, preset, "-o", saved)
    first, second = grow_source(preset), grow_source(saved)
    for name in ("link_tip", "link_radius_base", "stem_parent"):
        assert getattr(first, name).tobytes() == getattr(second, name).tobytes()


def test_a_scan_in_leaf_and_bare(capsys, tmp_path) -> None:
    scan = tmp_path / "pole.csv"
    scan.write_text("".join(f"0.05,1,0,0,{i},0,0,2,{i}\n" for i in range(5)))
    bare, leafy = figures(capsys, scan, "--leaf-area", 0), figures(capsys, scan, "--leaf-area", 9)
    assert (bare["leaves"], bare["height_m"]) == (0, 5.0)
    assert leafy["leaf_area_m2"] == pytest.approx(9.0, rel=0.01)
    assert leafy["frequencies_hz"][0] < bare["frequencies_hz"][0]
    assert bare["import_report"]["repaired"] == ["axes normalised (5)"]


def test_a_scan_says_how_many_cylinders_it_has(capsys, tmp_path) -> None:
    for count, said in ((1, "scanned cylinders: 1 row taken"), (10, "scanned cylinders: 10 rows taken")):
        scan = tmp_path / "pole.csv"
        scan.write_text("".join(f"0.05,1,0,0,{i},0,0,1,{i}\n" for i in range(count)))
        main(["grow", str(scan)])
        assert said in capsys.readouterr().err.splitlines()


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (
            ["hazel", "-o", "plant.png"],
            "--output = 'plant.png': expected a path that ends in .npz, .toml or .obj",
        ),
        (["hazel", "-o", "none/plant.npz"], "--output = 'none/plant.npz': expected a folder that exists"),
        (["hazle"], "hazle: expected a built-in species or grammar, or a file: did you mean hazel?"),
        (["none.xml"], "none.xml: expected a file that exists"),
        (["hazel", "--seed", "2147483648"], "Invalid value for '--seed': 2147483648 is not in the range"),
        (["hazel", "--seed", "-1"], "Invalid value for '--seed': -1 is not in the range"),
        (
            ["pole.csv", "--leaf-area", "-2"],
            "Invalid value for '--leaf-area': -2.0 is not in the range x>=0.0",
        ),
        (["pole.csv", "--leaf-area", "nan"], "Invalid value for '--leaf-area': nan is not a finite number"),
        (["hazel", "--seed", "abc"], "Invalid value for '--seed': 'abc' is not a valid whole number."),
        (["pole.csv", "--leaf-area", "abc"], "Invalid value for '--leaf-area': 'abc' is not a valid number."),
        (["hazel", "--leaf-area", "5"], "leaf area = 5.0: expected a scan (.csv, .mat) as the source"),
        (["pole.csv", "-o", "pole.toml"], "pole.csv: expected a source that is a species"),
    ],
)
def test_mistakes(capsys, tmp_path, monkeypatch, arguments, said) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "pole.csv").write_text("0.05,1,0,0,0,0,0,1,0\n")
    with pytest.raises(SystemExit) as caught:
        main(["grow", *arguments])
    out, err = capsys.readouterr()
    assert caught.value.code == 2
    assert out == ""
    assert err.splitlines()[-1].startswith(f"windswept: {said}")

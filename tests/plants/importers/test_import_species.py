"""Foreign presets: what is taken, what is clamped, and that the species grows and reads back."""

import pytest

from windswept.plants.importers import import_species
from windswept.plants.species import load_species
from windswept.plants.validate import validate
from windswept.plants.weber_penn import grow
from windswept.plants.write_species import write_species

from .preset_files import PRESETS


@pytest.fixture
def imported(tmp_path):
    def read(name):
        path = tmp_path / name
        path.write_text(PRESETS[name])
        return import_species(path)

    return read


@pytest.mark.parametrize("name", PRESETS)
def test_every_family_grows_and_reads_back(imported, tmp_path, name) -> None:
    species, report = imported(name)
    write_species(species, tmp_path / "saved.toml")
    assert load_species(tmp_path / "saved.toml") == species
    plant = grow(species, seed=2)
    validate(plant)
    assert 0.4 * species.growth.scale < plant.height < 2.0 * species.growth.scale
    assert report.taken
    assert all("\n" not in line for line in report.lines())


def test_arbaro(imported) -> None:
    species, report = imported("birch.xml")
    growth = species.growth
    assert species.name == "made_up_birch"
    assert (growth.scale, growth.scale_0, growth.base_splits, growth.leaves) == (9.5, 1.2, 1, -12)
    assert (growth.level[0].taper, growth.level[0].curve_v, growth.level[1].curve_v) == (2.1, -25, 360)
    assert "Flare -0.8 -> 0" in report.clamped
    assert "1CurveV 480 -> 360" in report.clamped
    assert {"LeafStemLen", "LeafDistrib", "Smooth", "1nBranchDist"} <= set(report.without_counterpart)
    assert "level[2].curve_res" in report.defaulted
    assert "material" in report.defaulted
    assert species.look.leaf_shape == "lobed"


def test_several_trunks_are_splits_at_the_foot(imported) -> None:
    species, report = imported("tuft.xml")
    assert species.growth.base_splits == 32
    assert species.growth.level[0].split_angle == 10
    assert species.growth.levels == 1
    assert "levels 2 -> 1 (length 0 on level 1)" in report.clamped
    assert "0Branches 49 trunks -> 32 base_splits" in report.clamped


def test_trunks_keep_their_own_branches(tmp_path) -> None:
    text = PRESETS["birch.xml"].replace("</species>", "<param name='0Branches' value='3'/></species>")
    (tmp_path / "trunks.xml").write_text(text)
    species, _ = import_species(tmp_path / "trunks.xml")
    assert species.growth.base_splits == 3
    assert species.growth.level[1].branches == 3 * 12


ASPEN = {
    "Shape": 7,
    "Levels": 3,
    "Scale": 13,
    "ScaleV": 3,
    "BaseSize": 0.4,
    "Ratio": 0.015,
    "RatioPower": 1.2,
    "Flare": 0.6,
    "Lobes": 5,
    "LobeDepth": 0.07,
    "Leaves": 25,
    "LeafScale": 0.17,
    "LeafScaleX": 1,
    "AttractionUp": 0.5,
    "0Length": 1,
    "1Length": 0.3,
    "2Length": 0.6,
    "1DownAngle": 60,
    "1DownAngleV": -50,
    "2DownAngle": 45,
    "2DownAngleV": 10,
    "3DownAngle": 45,
    "3DownAngleV": 10,
    "1Rotate": 140,
    "2Rotate": 140,
    "3Rotate": 77,
    "1Branches": 50,
    "2Branches": 30,
    "0CurveRes": 3,
    "1CurveRes": 5,
    "2CurveRes": 3,
    "0CurveV": 20,
    "1Curve": -40,
    "1CurveV": 50,
    "2Curve": -40,
    "2CurveV": 75,
}
"""Weber and Penn's published table of the quaking aspen (PHYSICS B8)."""


def test_the_published_aspen_is_the_built_in_one(tmp_path) -> None:
    params = "".join(f"<param name='{name}' value='{value}'/>" for name, value in ASPEN.items())
    (tmp_path / "aspen.xml").write_text(f"<arbaro><species name='aspen'>{params}</species></arbaro>")
    found = import_species(tmp_path / "aspen.xml")[0].growth.model_dump()
    wanted = load_species("quaking_aspen").growth.model_copy(update={"leaf_bend": 0.0}).model_dump()
    levels = zip(found.pop("level")[:3], wanted.pop("level")[:3], strict=True)
    assert found == wanted
    assert all(one == other for one, other in levels)


def test_arbaro_list(imported) -> None:
    species, _ = imported("plain.txt")
    assert species.name == "plain_tree"
    assert (species.growth.shape, species.growth.scale, species.growth.level[1].branches) == (4, 6.0, 15)


def test_tree_gen(imported) -> None:
    species, report = imported("ash.py")
    growth = species.growth
    assert (growth.scale, growth.scale_v, growth.base_size, growth.leaves) == (11, 2, 0.3, 12)
    assert growth.attraction_up == 0.5
    assert [level.down_angle_v for level in growth.level] == [0, -40, 10, 10]
    assert {"tropism[1]", "bend_v", "blossom_rate", "colour"} <= set(report.without_counterpart)


def test_sapling(imported) -> None:
    species, report = imported("aspen.py")
    growth = species.growth
    assert growth.shape == 7
    assert growth.flare == pytest.approx(0.25)
    assert growth.level[0].down_angle == 0.0
    assert growth.attraction_up == 0.5
    assert growth.prune_ratio == 0.0
    assert [level.branches for level in growth.level[1:3]] == [25, 8]
    assert (growth.level[3].down_angle, growth.level[3].rotate) == (45.0, 137.5)
    assert {"wind", "gust", "boneStep", "handleType"} <= set(report.without_counterpart)


def test_ez_tree_lengths_are_fractions_here(imported) -> None:
    species, _ = imported("oak.json")
    growth = species.growth
    assert (growth.shape, growth.levels, growth.scale, growth.base_size) == (3, 3, 14, 0.4)
    assert growth.ratio == pytest.approx(0.6 / 14)
    assert growth.level[1].length == pytest.approx(9 / 14)
    assert growth.level[2].length == pytest.approx(5 / 9 / (1 - 0.6 * 0.6))
    assert (growth.level[1].branches, growth.level[2].branches) == (7, 4)
    assert growth.leaf_scale == 0.9


def test_helios_with_its_malformed_header(imported) -> None:
    species, report = imported("almond.xml")
    growth = species.growth
    assert species.name == "made_up_almond"
    assert (growth.scale, growth.base_splits, growth.level[1].branches) == (3.5, 2, 12)
    assert growth.level[3].down_angle == 40
    assert report.repaired == ["XML header without quotation marks"]
    assert {"LeafFile", "tree 'another'"} <= set(report.without_counterpart)


def test_code_in_a_preset_never_runs(tmp_path) -> None:
    from windswept.errors import InputError

    trace = tmp_path / "ran"
    for text in (
        f"open({str(trace)!r}, 'w')\nparams = {{'g_scale': 3}}\n",
        f"params = {{'g_scale': open({str(trace)!r}, 'w')}}\n",
        f"{{'curveRes': __import__('pathlib').Path({str(trace)!r}).touch()}}\n",
        f"params = dict(g_scale=open({str(trace)!r}, 'w'))\n",
    ):
        (tmp_path / "code.py").write_text(text)
        with pytest.raises(InputError):
            import_species(tmp_path / "code.py")
    assert not trace.exists()

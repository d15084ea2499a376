"""Whole plants: every built-in grammar, the turtle's stems as links, radii, sizes."""

import math
import re
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest

import windswept.plants.lsystem as lsystem
from windswept.plants.lsystem import grammar_names, grow_lsystem
from windswept.plants.lsystem.form import GrammarForm, read_form
from windswept.plants.lsystem.grow_lsystem import grow_system
from windswept.plants.lsystem.read_system import read_system
from windswept.plants.lsystem.tidy import SHORTEST_LINK
from windswept.plants.lsystem.wood import THINNEST
from windswept.plants.validate import validate

FOLDER = Path(lsystem.__file__).parent / "grammars"


def grown(text, seed=0, **form):
    plant = grow_system(read_system(text, "test.l"), GrammarForm(**form), "test", seed)
    validate(plant)
    return plant


def arrays(plant):
    return {f.name: v for f in fields(plant) if isinstance(v := getattr(plant, f.name), np.ndarray)}


def lengths(plant):
    return np.linalg.norm(plant.link_tip - plant.link_base, axis=1)


@pytest.mark.parametrize("name", grammar_names())
def test_every_grammar_grows_a_valid_plant_of_sensible_size_the_same_for_a_seed(name):
    plants = [grow_lsystem(name, seed) for seed in (0, 0, 1)]
    one, same, other = map(arrays, plants)
    assert one.keys() == same.keys()
    assert all(one[key].tobytes() == same[key].tobytes() for key in one)
    assert one["link_tip"].tobytes() != other["link_tip"].tobytes()
    for seed, plant in enumerate(plants[1:]):
        validate(plant)
        assert plant.species == name
        assert plant.seed == seed
        assert 0.2 < plant.height < 15
        assert 50 <= plant.link_count <= 20_000
        assert plant.leaf_count > 50
        assert plant.leaf_area.sum() > 0.01
        assert plant.link_radius_base.min() >= THINNEST * (1 - 1e-6)
        assert plant.link_radius_base.max() < 0.06 * plant.height
        assert plant.link_tip[:, 2].min() > -0.05 * plant.height


@pytest.mark.parametrize("name", grammar_names())
def test_every_grammar_says_what_it_is_after(name):
    text = (FOLDER / f"{name}.l").read_text()
    assert "The Algorithmic Beauty of Plants" in " ".join(text.split())
    assert re.search(r"[Ff]igure \d\.\d+|[Cc]hapter \d", " ".join(text.split()))
    form = read_form(FOLDER / f"{name}.l")
    assert form.common_name
    assert form.summary


def test_there_are_twelve_grammars_or_more():
    assert len(grammar_names()) >= 12


def test_straight_links_merge_and_bent_ones_do_not():
    straight = grown("Axiom: " + "F(0.1)" * 40)
    assert straight.link_count == 8  # what is left of 40, so that a trunk still bends
    np.testing.assert_allclose(lengths(straight), 0.5, rtol=1e-5)
    bent = grown("angle increment: 5\nAxiom: " + "F(0.1)+" * 40)
    assert bent.link_count == 40


def test_a_coarse_trunk_is_divided():
    plant = grown("Axiom: F(4)[&(50)F(1)]F(4)")
    np.testing.assert_array_equal(np.diff(plant.stem_link_start), [8, 4])
    assert plant.link_tip[3, 2] == plant.link_base[plant.stem_link_start[1], 2] == 4.0


def test_links_shorter_than_a_millimetre_merge_and_keep_what_they_carry():
    plant = grown("Axiom: F(0.5)F(0.0004)[&(40)F(0.2)]F(0.0004)[F(0.0001)~l(0.1)]F(0.5)")
    assert plant.stem_count == 2
    assert lengths(plant).min() >= SHORTEST_LINK
    assert plant.leaf_count == 1
    assert plant.leaf_position[0, 2] == pytest.approx(0.5, abs=2e-3)


def test_links_merge_only_where_nothing_grows_out():
    plant = grown("Axiom: F(1)F(1)[&(50)F(1)]F(1)F(1)~l(0.1)" + "F(1)" * 6, scale_m=0.1)
    assert {round(float(z), 4) for z in plant.link_tip[: plant.stem_link_start[1], 2]} >= {0.2, 0.4}
    assert plant.height == pytest.approx(1.0)


def test_widths_are_diameters_in_the_grammars_unit():
    plant = grown("Axiom: !(2)F(40)!(1)F(40)", scale_m=0.01)
    assert plant.stem_radius[0] == pytest.approx(0.01)
    assert plant.link_radius_base[0] == pytest.approx(0.01)
    assert plant.link_radius_tip[-1] == pytest.approx(0.005)
    assert plant.stem_taper[0] == pytest.approx(0.5)
    assert plant.height == pytest.approx(0.8)


def test_without_widths_cross_sections_add_up():
    plant = grown("Axiom: F[+(30)F][-(30)F]F[&(30)F]F", tip_radius=0.01)
    # four tips beyond the foot, two above the first pair, one at the top
    assert plant.link_radius_base[0] == pytest.approx(0.01 * math.sqrt(4))
    assert sorted({round(float(r), 6) for r in plant.link_radius_base}) == [0.01, 0.014142, 0.02]


def test_leaves_keep_their_area_and_scale():
    plant = grown("Axiom: F(1){.f(2)+(90).f(3)+(90).f(2)}@A(0.02)", scale_m=0.1)
    np.testing.assert_allclose(plant.leaf_area, [0.06, 0.02], rtol=1e-5)


def test_joint_strength_reaches_the_plant():
    plant = grown("Axiom: F(1)[&(60)@K(0.25)F(1)]F(1)")
    np.testing.assert_array_equal(plant.joint_scale[plant.stem_order[plant.link_stem] == 1], 0.25)
    np.testing.assert_array_equal(plant.joint_scale[plant.stem_order[plant.link_stem] == 0], 1.0)
    assert grown("Axiom: F(1)").joint_scale is None


def test_wood_and_leaves_that_come_before_all_wood():
    plant = grown("Axiom: ~l(0.1)[&(20)F][^(20)F]")
    assert plant.stem_count == 2
    np.testing.assert_array_equal(plant.stem_parent, -1)
    np.testing.assert_array_equal(plant.leaf_position, [[0, 0, 0]])


def test_seed_of_the_file_shifts_the_seeds():
    rules = "Axiom: F(1 + ran(1))"
    assert grown("Seed: 3\n" + rules).height == grown(rules, seed=3).height != grown(rules).height


def test_look_and_material_come_from_the_table_beside_the_grammar(tmp_path):
    path = tmp_path / "Mein Baum.l"
    path.write_text("Axiom: F(100)\n")
    path.with_suffix(".toml").write_text(
        'scale_m = 0.01\n[material]\nyoungs_modulus = 1e9\n[look]\nleaf_shape = "round"\n'
    )
    plant = grow_lsystem(path)
    assert plant.species == "mein_baum"
    assert plant.height == pytest.approx(1.0)
    assert plant.material.youngs_modulus == 1e9
    assert plant.look.leaf_shape == "round"

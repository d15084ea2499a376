"""Species files of underbrush: what is there, and one line for every mistake."""

from __future__ import annotations

from pathlib import Path

import pytest

from windswept.cli import main
from windswept.errors import InputError
from windswept.plants.species import load_species
from windswept.plants.underbrush import load_underbrush, underbrush_names
from windswept.plants.underbrush.library import _FOLDER

STEM = '[[component]]\nname = "stem"\nshape = "round"\nlength_mm = 300\nwidth_mm = 2\nthickness_mm = 0.4\n'
STEM += "outline = [1, 0.6]\nyoungs_modulus = 1e9\n"
HEAD = 'kind = "underbrush"\nname = "weed"\ncommon_name = "Weed"\n'


def test_what_the_library_holds() -> None:
    names = underbrush_names()
    assert {
        "meadow_fescue",
        "tufted_hair_grass",
        "giant_reed",
        "male_fern",
        "white_clover",
        "heather",
    } <= set(names)
    assert {"oxeye_daisy", "common_poppy", "cornflower"} <= set(names)
    for name in names:
        species = load_underbrush(name)
        assert species.name == name
        assert species.common_name
        assert species.latin_name
        assert 20 < len(species.summary) < 90


def test_species_lists_them(capsys: pytest.CaptureFixture[str]) -> None:
    main(["species"])
    listed = capsys.readouterr().out
    assert all(f"\n{name} " in listed for name in underbrush_names())


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (
            ("thickness_mm = 0.4", "thickness_mm = 0"),
            "component[0].thickness_mm = 0: expected a number above 0 to 100",
        ),
        (
            ("thickness_mm = 0.4", "thickness_mm = nan"),
            "component[0].thickness_mm = nan: expected a number above 0",
        ),
        (("length_mm = 300", "length_mm = -3"), "component[0].length_mm = -3: expected a number above 0"),
        (("length_mm", "lenght_mm"), "expected a known key: did you mean length_mm?"),
        (("outline = [1, 0.6]", "outline = [1, 2]"), "expected 2 to 33 numbers from 0 to 1"),
        (('name = "stem"', 'name = "stem"\nparent = "root"'), "expected no parent on the first component"),
        (('"round"', '"square"'), 'expected one of "flat", "round"'),
        (("youngs_modulus = 1e9\n", ""), "youngs_modulus: expected this key to be given"),
        (('kind = "underbrush"\n', ""), "kind: expected this key to be given"),
    ],
)
def test_a_wrong_value_is_said_in_one_line(tmp_path: Path, change: tuple[str, str], words: str) -> None:
    path = tmp_path / "weed.toml"
    path.write_text((HEAD + STEM).replace(*change))
    with pytest.raises(InputError) as caught:
        load_underbrush(path)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)


def test_two_components_of_one_name_and_a_parent_below(tmp_path: Path) -> None:
    path = tmp_path / "weed.toml"
    path.write_text(HEAD + STEM + STEM)
    with pytest.raises(InputError, match=r"component\[1\]\.name = 'stem': expected a name that no other"):
        load_underbrush(path)
    path.write_text(HEAD + STEM + STEM.replace('"stem"', '"leaf"\nparent = "twig"'))
    with pytest.raises(
        InputError, match=r"component\[1\]\.parent = 'twig': expected a component above it \(stem\)"
    ):
        load_underbrush(path)


def test_components_hang_at_most_eight_deep(tmp_path: Path) -> None:
    path = tmp_path / "weed.toml"
    chain = [STEM.replace('"stem"', f'"s{k + 1}"\nparent = "s{k}"') for k in range(8)]
    text = HEAD + STEM.replace('"stem"', '"s0"')
    path.write_text(text + "".join(chain[:7]))
    load_underbrush(path)
    path.write_text(text + "".join(chain))
    with pytest.raises(InputError, match=r"component\[8\]\.parent = 's7': expected at most 8 components"):
        load_underbrush(path)


def test_a_name_that_means_nothing() -> None:
    with pytest.raises(InputError, match="did you mean white_clover"):
        load_underbrush("white_clove")


def test_grow_says_where_underbrush_belongs() -> None:
    with pytest.raises(InputError, match="underbrush is grown into scenes"):
        load_species(_FOLDER / "heather.toml")


@pytest.mark.parametrize("source", ["heather", str(_FOLDER / "heather.toml")])
def test_grow_refuses_underbrush_in_one_line(source: str, capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["grow", source])
    assert ended.value.code == 2
    assert capsys.readouterr().err.strip().endswith("underbrush is grown into scenes")

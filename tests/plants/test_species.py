"""Species files: the built-in ones are right, bad ones are told in one line."""

from dataclasses import fields
from pathlib import Path

import pytest

from windswept.errors import InputError
from windswept.plants import species as species_module
from windswept.plants.plant import Look, Material
from windswept.plants.species import load_species, species_names
from windswept.plants.species_form import LookForm, MaterialForm

GOOD = """name = "sample"
common_name = "Sample"
[growth]
shape = 0
levels = 2
scale = 10.0
ratio = 0.02
[[growth.level]]
length = 1.0
[[growth.level]]
length = 0.5
branches = 5
"""


@pytest.fixture
def message_of(tmp_path, monkeypatch):
    """The one line that a bad text causes."""
    monkeypatch.chdir(tmp_path)

    def read(text):
        Path("bad.toml").write_bytes(text if isinstance(text, bytes) else text.encode())
        with pytest.raises(InputError) as caught:
            load_species("bad.toml")
        assert "\n" not in str(caught.value)
        assert len(str(caught.value)) < 250
        return str(caught.value)

    return read


def test_the_built_in_species():
    expected = {
        "black_tupelo",
        "california_black_oak",
        "hazel",
        "quaking_aspen",
        "scots_pine",
        "weeping_willow",
    }
    assert expected <= set(species_names())


@pytest.mark.parametrize("name", species_names())
def test_built_in_species_load_and_say_what_they_are(name):
    species = load_species(name)
    assert species.name == name
    assert species.summary
    assert species.latin_name
    assert (
        Path(species_module.__file__)
        .with_name("species")
        .joinpath(f"{name}.toml")
        .read_text()
        .startswith("# ")
    )


def test_published_numbers_of_the_willow():
    growth = load_species("weeping_willow").growth
    assert (growth.shape, growth.levels, growth.scale, growth.scale_v, growth.base_size) == (
        3,
        4,
        15,
        5,
        0.05,
    )
    assert (growth.prune_ratio, growth.prune_width, growth.prune_width_peak) == (1, 0.4, 0.6)
    assert (growth.prune_power_low, growth.prune_power_high, growth.attraction_up) == (0.001, 0.5, -2)
    assert [level.curve_res for level in growth.level] == [8, 16, 12, 1]
    assert [level.seg_splits for level in growth.level] == [0.1, 0.2, 0.2, 0]
    assert [level.branches for level in growth.level[1:]] == [25, 10, 150]


def test_a_path_is_read_and_optional_parts_have_defaults(tmp_path):
    path = tmp_path / "sample.toml"
    path.write_text(GOOD)
    for source in (path, str(path)):
        species = load_species(source)
        assert species.plant_material() == Material()
        assert species.plant_look() == Look()


@pytest.mark.parametrize(("form", "noun"), [(MaterialForm, Material), (LookForm, Look)])
def test_forms_have_the_fields_of_what_they_fill(form, noun):
    assert list(form.model_fields) == [item.name for item in fields(noun)]


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            "branches = 5",
            "branchs = 5",
            "growth.level[1].branchs: expected a known key: did you mean branches?",
        ),
        (
            "length = 0.5",
            "lenght = 0.5",
            "growth.level[1].lenght: expected a known key: did you mean length?",
        ),
        (
            "common_name",
            "comon_name",
            "comon_name: expected a known key: did you mean common_name?",
        ),
        ("[growth]", "[groth]", ": did you mean growth?"),
        ("ratio = 0.02\n", "", "growth.ratio: expected this key to be given: a number from 0.001 to 0.5"),
        ("length = 0.5", "length = -1", "growth.level[1].length = -1: expected a number from 0 to 10"),
        (
            "length = 0.5\n",
            "",
            "growth.level[1].length = 0.0: expected a length above 0, as growth.levels = 2",
        ),
        ("scale = 10.0", "scale = nan", "growth.scale = nan: expected a number from 0.05 to 150"),
        ("scale = 10.0", "scale = -inf", "growth.scale = -inf: expected a number from 0.05 to 150"),
        ("scale = 10.0", 'scale = "big"', "growth.scale = 'big': expected a number"),
        ("scale = 10.0", "scale = 2020-01-01", "growth.scale = datetime.date(2020, 1, 1): expected a number"),
        ("scale = 10.0", "scale = 1" + "0" * 400, "growth.scale = 1000"),
        ("scale = 10.0", "scale = 1" + "0" * 5000, "expected valid TOML"),
        ("levels = 2", "levels = true", "growth.levels = true: expected a whole number from 1 to 4"),
        ("levels = 2", "levels = 2.5", "growth.levels = 2.5: expected a whole number from 1 to 4"),
        (
            "branches = 5",
            "branches = 1000000",
            "growth.level[1].branches = 1000000: expected a whole number from 0",
        ),
        (
            "ratio = 0.02",
            "ratio = 0.02\nprune_width = 0",
            "growth.prune_width = 0: expected a number above 0 to 2",
        ),
        ('"sample"', '"../../etc"', "name = '../../etc': expected a name of a-z, 0-9 and _"),
        ('"Sample"', '"a\\nb"', "common_name = 'a\\nb': expected one line of text"),
        ('"Sample"', '"' + "x" * 9000 + '"', "expected one line of text"),
        ('"Sample"', "5", "common_name = 5: expected one line of text"),
    ],
)
def test_bad_value(message_of, old, new, said):
    message = message_of(GOOD.replace(old, new, 1))
    assert message.startswith("bad.toml: ")
    assert said in message


@pytest.mark.parametrize(
    ("tail", "said"),
    [
        (
            "[look]\nbark_colour = [0.1, 2.0, 0.5]\n",
            "look.bark_colour[1] = 2.0: expected three numbers from 0 to 1",
        ),
        ("[look]\nbark_colour = [0.1]\n", "look.bark_colour"),
        ("[look]\nleaf_shape = 'ovel'\n", 'look.leaf_shape = \'ovel\': expected one of "oval", "round"'),
        (
            "[material]\nyoungs_modulus = 0\n",
            "material.youngs_modulus = 0: expected a number from 1,000,000 to 1e+11",
        ),
        (
            "[material]\ndamping_ratio = 1.0\n",
            "material.damping_ratio = 1.0: expected a number from 0 to 0.95",
        ),
        ("[loook]\na = 1\n", "loook: expected a known key: did you mean look?"),
        ('"a\\nb" = 1\n', "growth.level[1].a b: expected a known key"),
        ("x = [1,\n", "line 14: expected valid TOML (Invalid value)"),
        ("x = " + "[" * 100_000, "expected valid TOML (a number or a nesting is too large)"),
    ],
)
def test_bad_end(message_of, tail, said):
    assert said in message_of(GOOD + tail)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("hello there\n", "line 1: expected valid TOML (Expected '=' after a key in a key/value pair)"),
        ("", "name: expected this key to be given"),
        (b"\xff\xfe\x00", "byte 0: expected UTF-8 text"),
        ("#" * 2_000_000, "a species file of at most 1,048,576 bytes"),
        ("name = 't'\ncommon_name = 'T'\ngrowth = 5\n", "growth = 5: expected a table"),
        (GOOD.split("[[")[0], "growth.level: expected this key to be given: 1 to 5 tables"),
        (GOOD.split("[[")[0] + "level = []\n", "growth.level = []: expected 1 to 5 tables"),
        (GOOD.split("[[")[0] + "level = [1]\n", "growth.level[0] = 1: expected a table"),
        (GOOD.split("[[")[0] + "[growth.level]\nlength = 1\n", "expected 1 to 5 tables"),
    ],
)
def test_not_a_species_file(message_of, text, said):
    assert said in message_of(text)


@pytest.mark.parametrize(
    ("source", "said"),
    [
        ("quaking_aspn", "did you mean quaking_aspen?"),
        ("zzz", "one of black_tupelo"),
        ("", "species: expected a built-in species"),
        ("a\nb", "a b: expected a built-in species"),
        ("absent.toml", "absent.toml: expected a file that exists"),
        ("a\x00b.toml", "embedded null"),
        ("folder.toml", "folder.toml: expected a species file, not a directory"),
        (Path("quaking_aspen"), "expected a file that exists"),
    ],
)
def test_bad_source(tmp_path, monkeypatch, source, said):
    monkeypatch.chdir(tmp_path)
    Path("folder.toml").mkdir()
    with pytest.raises(InputError) as caught:
        load_species(source)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_the_error_carries_its_parts(tmp_path):
    path = tmp_path / "sample.toml"
    path.write_text(GOOD.replace("shape = 0", "shape = 9"))
    with pytest.raises(InputError) as caught:
        load_species(path)
    assert (caught.value.source, caught.value.place, caught.value.value) == (str(path), "growth.shape", 9)
    assert caught.value.expected == "a whole number from 0 to 8"

"""The declarative part of L-Py files is read; Python is refused and never run."""

import numpy as np
import pytest

from windswept.errors import InputError
from windswept.plants.lsystem import grow_lsystem
from windswept.plants.lsystem.derive import derive
from windswept.plants.lsystem.read_lpy import read_lpy
from windswept.plants.validate import validate

PLANT = """# a little tree
from_here = 0.7
SHORTER = 0.8  # per order
ANGLE = 2 * 20
STEPS = 5
module Apex(l), Leaf
derivation length: STEPS
Axiom: _(0.02)Apex(1)
production:
Apex(l) --> F(l)[+(ANGLE)Apex(l * SHORTER)][-(ANGLE)Apex(l * from_here)]/(90)Apex(l * SHORTER)
interpretation:
maximum depth: 2
Apex(l) --> Leaf
Leaf --> ~l(0.1)
endlsystem
###### INITIALISATION ######

__lpy_code_version__ = 1.1

def __initialiseContext__(context):
    raise SystemExit
"""


def test_a_declarative_file_grows(tmp_path):
    path = tmp_path / "little_tree.lpy"
    path.write_text(PLANT)
    plant = grow_lsystem(path)
    validate(plant)
    assert plant.species == "little_tree"
    assert plant.leaf_count == 3**5
    assert plant.stem_radius[0] == pytest.approx(0.02)  # L-Py's widths are radii


def test_rules_mean_what_they_mean_in_cpfg():
    system = read_lpy(
        "x = 3\nAxiom: A(x)B\nderivation length: 2\nproduction:\nA(n) --> A(n**2)B\nB < B --> C\n", "t.lpy"
    )
    assert str(derive(system, np.random.default_rng(0))) == "A(81)BBC"
    assert system.reading.angle == 60


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("import os", "line 3"),
        ("from math import *", "line 3"),
        ("def f(x): return x", "line 3"),
        ("for i in range(3): print(i)", "line 3"),
        ("while True: pass", "line 3"),
        ("if True:", "line 3"),
        ("x = open('marker', 'w')", "line 3 = \"open('marker', 'w')\": expected a number; Python is not run"),
        ("x = __import__('os')", "line 3"),
        ("x = [1, 2]", "line 3"),
        ("x, y = 1, 2", "line 3"),
        ("A(x) :\n  produce B", "line 3"),
        ("A(x) :", "line 3"),
        ("A --> produce B", "line 3"),
        ("@decorator", "line 3"),
        ("A --> F(open('marker'))", "line 3: expected a rule"),
        ("A --> F(sqrt(x for x in y))", "line 3"),
        ("exec('1')", "line 3"),
    ],
)
def test_python_is_refused_with_its_line(line, expected):
    with pytest.raises(InputError) as caught:
        read_lpy(f"Axiom: A\nderivation length: 1\n{line}\n", "t.lpy")
    assert str(caught.value).startswith("t.lpy: ")
    assert expected in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("ending", ["l", "lpy"])
@pytest.mark.parametrize("call", ["open({!r}, 'w')", "__import__('pathlib').Path({!r}).touch()"])
@pytest.mark.parametrize(
    "place", ["Axiom: F({})", "x = {}\nAxiom: F", "Axiom: F\nF --> F({})", "{}\nAxiom: F"]
)
def test_nothing_in_a_file_is_ever_run(tmp_path, ending, call, place):
    marker = tmp_path / "marker"
    path = tmp_path / f"evil.{ending}"
    path.write_text("derivation length: 1\n" + place.format(call.format(str(marker))) + "\n")
    with pytest.raises(InputError):
        grow_lsystem(path)
    assert not marker.exists()


def test_the_trailer_of_the_editor_is_not_run(tmp_path):
    path = tmp_path / "tree.lpy"
    path.write_text(f"Axiom: F\n##### INITIALISATION #####\nopen({str(tmp_path / 'marker')!r}, 'w')\n")
    grow_lsystem(path)
    assert not (tmp_path / "marker").exists()


def test_long_names_come_back_in_messages():
    with pytest.raises(InputError, match=r"line 3: .* stops to be one at \)Leaf"):
        read_lpy("module Leaf\nAxiom: F\nF --> F)Leaf\n", "t.lpy")


def test_empty_and_without_axiom():
    with pytest.raises(InputError, match="the file is empty"):
        read_lpy(" \n", "t.lpy")
    with pytest.raises(InputError, match="an Axiom: line"):
        read_lpy("x = 3\n", "t.lpy")

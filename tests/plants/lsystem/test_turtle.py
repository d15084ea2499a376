"""What the turtle draws, against closed forms."""

import math

import numpy as np
import pytest

from windswept.errors import InputError
from windswept.plants.lsystem.frame import START
from windswept.plants.plant import LEAF_FILL


def word(axiom, *more):
    return "\n".join((*more, f"Axiom: {axiom}"))


def test_starts_upright_with_its_left_to_minus_x():
    np.testing.assert_array_equal(np.cross(START.heading, START.left), START.up)
    assert START.heading == (0, 0, 1)
    assert START.left == (-1, 0, 0)


@pytest.mark.parametrize(
    ("turn", "heading"),
    [
        ("+(90)", (-1, 0, 0)),
        ("-(90)", (1, 0, 0)),
        ("&(90)", (0, 1, 0)),
        ("^(90)", (0, -1, 0)),
        ("\\(90)+(90)", (0, 1, 0)),
        ("/(90)+(90)", (0, -1, 0)),
        ("|", (0, 0, -1)),
        ("+", (-1, 0, 0)),
    ],
)
def test_each_turn_goes_where_the_book_says(drawn, turn, heading):
    sketch = drawn(word(f"{turn}F(2)", "angle factor: 4"))
    np.testing.assert_allclose(sketch.stems[0].nodes, [(0, 0, 0), 2 * np.array(heading)], atol=1e-12)


def test_a_square_closes(drawn):
    (stem,) = drawn(word("F+F+F+F", "angle increment: 90")).stems
    np.testing.assert_allclose(stem.nodes[4], stem.nodes[0], atol=1e-12)
    assert len({tuple(np.round(node, 9)) for node in stem.nodes}) == 4


@pytest.mark.parametrize("order", [1, 2])
def test_three_dimensional_hilbert_curve_visits_every_cell_once(drawn, order):
    # ABOP figure 1.19 b, with | for half a turn
    rules = """derivation length: %d
angle increment: 90
Axiom: A
A --> B-F+CFC+F-D&F^D-F+&&CFC+F+B//
B --> A&F^CFB^F^D^^-F-D^|F^B|FC^F^A//
C --> |D^|F^B-F+C^F^A&&FA&F^C+F+B^F^D//
D --> |CFB-F+B|FA&F^A&&FB-F+B|FC//"""
    (stem,) = drawn(rules % order).stems
    cells = np.round(np.array(stem.nodes)).astype(int)
    assert len(cells) == 8**order
    assert len(np.unique(cells, axis=0)) == 8**order
    assert (np.ptp(cells, axis=0) == 2**order - 1).all()


def test_rolling_to_the_vertical_makes_left_horizontal(drawn):
    # after any turns, $ then + turns within a plane whose normal is horizontal's: the left is level
    sketch = drawn(word("+(35)&(20)/(77)$[+(90)F]F"))
    side = np.diff(sketch.stems[0].nodes, axis=0)[0]
    assert side[2] == pytest.approx(0.0, abs=1e-12)
    upright = drawn(word("$[+(90)F]F")).stems[0].nodes
    np.testing.assert_allclose(upright[1], (-1, 0, 0), atol=1e-12)


def test_brackets_open_stems_and_give_the_state_back(drawn):
    sketch = drawn(word("F[+F[-F]F]F[[F]]F"))
    assert [stem.order for stem in sketch.stems] == [0, 1, 2, 1]
    assert [stem.seat for stem in sketch.stems] == [None, (0, 1), (1, 1), (0, 2)]
    assert [len(stem.nodes) for stem in sketch.stems] == [4, 3, 2, 2]
    assert sketch.stems[0].nodes[3] == (0, 0, 3)


def test_a_bracket_without_wood_before_it_is_a_trunk(drawn):
    sketch = drawn(word("[+F][-F]f(3)F"))
    assert [stem.seat for stem in sketch.stems] == [None, None, None]
    assert sketch.stems[2].nodes == [(0, 0, 3), (0, 0, 4)]


def test_a_gap_is_bridged(drawn):
    (stem,) = drawn(word("Ff(2)F")).stems
    assert stem.nodes == [(0, 0, 0), (0, 0, 1), (0, 0, 4)]


def test_width_and_strength_belong_to_the_branch(drawn):
    sketch = drawn(word("!(0.5)F[!(0.2)@K(3)F]F!F"))
    assert sketch.stems[0].width == [0.5, 0.5, pytest.approx(0.35)]
    assert sketch.stems[1].width == [0.2]
    assert (sketch.stems[0].strength, sketch.stems[1].strength) == ([1, 1, 1], [3])


def test_tropism_turns_by_e_times_the_sine(drawn):
    angle, e = math.radians(40), 0.22
    sketch = drawn(word("&(40)FF", "tropism direction: 0, 0, -1", f"elasticity: {e}"))
    rows = np.diff(sketch.stems[0].nodes, axis=0)
    turned = math.acos(rows[0] @ rows[1])
    assert turned == pytest.approx(e * math.sin(angle))
    assert rows[1][2] < rows[0][2]
    same = drawn(word(f"@Tx(0,0,-1)@Ts({e})&(40)FF"))
    np.testing.assert_allclose(same.stems[0].nodes, sketch.stems[0].nodes)


def area(leaf):
    return LEAF_FILL * leaf.length * leaf.width


@pytest.mark.parametrize(
    ("polygon", "expected"),
    [
        ("{.f(2)+(90).f(3)+(90).f(2)+(90)}", 6.0),
        ("{f(2)+(90)f(3)+(90)f(2)+(90)f(3)}", 6.0),
        ("{.[+(45)G(2).]G(3).[-(45)G(2).]}", None),
        ("{-(60)f+(60)f+(60)f+(60)f+(60)f+(60)f}", 1.5 * math.sqrt(3)),
    ],
)
def test_a_polygon_becomes_a_leaf_of_its_area(drawn, polygon, expected):
    (leaf,) = drawn(word("F" + polygon)).leaves
    if expected is not None:
        assert area(leaf) == pytest.approx(expected)
    assert leaf.seat == (0, 1)
    assert np.dot(leaf.axis, leaf.normal) == pytest.approx(0, abs=1e-12)
    assert np.linalg.norm(leaf.axis) == pytest.approx(1)
    assert leaf.normal[1] < 0  # up, as the turtle starts


def test_polygons_may_reach_across_brackets_and_lines_are_none(drawn):
    # ABOP figure 5.5: the polygon opens in a branch and closes behind it
    assert len(drawn(word("F[+G(2){.].G.}")).leaves) == 1
    assert drawn(word("F{.f.f.}{}{.}")).leaves == []


def test_surfaces_and_leaves_of_an_area(drawn):
    long, wide, flat = drawn(word("F~l(0.4)~l(0.4, 0.1)@A(0.02)"), aspect=0.25).leaves
    assert (long.length, long.width) == (0.4, 0.1)
    assert (wide.length, wide.width) == (0.4, 0.1)
    assert area(flat) == pytest.approx(0.02)
    assert flat.width / flat.length == pytest.approx(0.25)
    assert flat.in_metres
    assert (long.axis, long.normal) == (START.heading, START.up)


def test_homomorphism_is_drawn_and_not_derived(drawn):
    text = "derivation length: 2\nAxiom: A\nA --> AA\nhomomorphism\nA --> B\nB --> F(0.5)\nF(x) --> F(x)F(x)"
    assert len(drawn(text).stems[0].nodes) == 9


def test_homomorphism_keeps_to_its_maximum_depth(drawn):
    text = "Axiom: A\nhomomorphism\nmaximum depth: 3\nA --> FA"
    assert len(drawn(text).stems[0].nodes) == 4


def test_parameters_that_are_not_finite_are_refused(drawn):
    with pytest.raises(InputError, match=r"test.l: module F = inf: expected parameters between"):
        drawn("derivation length: 1\nAxiom: F(1e200)\nF(x) --> F(x * x)")
    with pytest.raises(InputError, match="expected a plant within"):
        drawn(word("F(9e5)F(9e5)"))
    with pytest.raises(InputError, match=r"module @K = 0\.0: expected a factor above 0"):
        drawn(word("@K(0)F"))

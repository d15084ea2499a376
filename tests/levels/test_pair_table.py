"""The look-up tables of pairs: simulated motion against the closed form of two rigid links (PHYSICS B3)."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from windswept.levels.pair_motion import Pairs, swing_pairs
from windswept.levels.pair_table import (
    COUNT,
    LOW,
    STEP,
    PairTable,
    equal_rods,
    look_up_rate,
    look_up_stiffness,
    pair_table,
    simulated_nodes,
    write_pair_table,
)

TOLERANCE = 0.02


def closed_form(ratios: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Displacement x k_p / (F L^2) and frequency / root(k_p / I), for small turns.

    Args:
        ratios: (4, ...) natural logarithms of stiffness and length ratio, angle, logarithm of density ratio.
    """
    stiffness, length, density = np.exp(ratios[0]), np.exp(ratios[1]), np.exp(ratios[3])
    cosine = np.cos(ratios[2])
    reach_square = 1.0 + length**2 + 2.0 * length * cosine
    # The wind is square to the line from joint to tip, so the child's lever is its share of that line.
    displacement = 1.0 + (length * (length + cosine) / reach_square) ** 2 / stiffness
    own = density * length**3 / 3.0
    across = own + 0.5 * density * length**2 * cosine
    whole = 1.0 / 3.0 + density * length + 2.0 * (across - own) + own
    masses = np.moveaxis(np.array([[whole, across], [across, own]]), (0, 1), (-2, -1))
    # Relative angles: K = diag(1, k_c / k_p).
    scale = np.stack([np.ones_like(stiffness), stiffness], axis=-1) ** -0.5
    slowest = np.linalg.eigvalsh(scale[..., :, None] * masses * scale[..., None, :])[..., -1]
    return displacement, np.sqrt(whole / slowest)


def looked_up(ratios: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The same from the table."""
    table = pair_table()
    stiffness, length, density = np.exp(ratios[0]), np.exp(ratios[1]), np.exp(ratios[3])
    pairs = list(zip(stiffness, length, ratios[2], density, strict=True))
    softness = [1.0 / look_up_stiffness(table.displacement, table.single, *pair[:3]) for pair in pairs]
    rate = [look_up_rate(table.rate, table.single, *pair) for pair in pairs]
    return np.array(softness), np.array(rate)


def nodes() -> np.ndarray:
    """(4, ...) coordinates of all nodes of the table."""
    axes = [low + step * np.arange(count) for low, step, count in zip(LOW, STEP, COUNT, strict=True)]
    return np.array(np.meshgrid(*axes, indexing="ij"))


def test_every_node_is_within_two_per_cent_of_the_closed_form() -> None:
    table = pair_table()
    displacement, rate = closed_form(nodes())
    assert np.abs(np.exp(table.displacement)[..., None] / displacement - 1.0).max() < TOLERANCE
    assert np.abs(np.exp(table.rate) / rate - 1.0).max() < TOLERANCE


def test_a_single_link_is_within_two_per_cent_of_the_closed_form() -> None:
    # F L^2 / k and root(k / I), in units of themselves.
    assert np.abs(np.exp(pair_table().single) - 1.0).max() < TOLERANCE


def test_between_nodes_the_table_is_within_two_per_cent_of_the_closed_form() -> None:
    rng = np.random.default_rng(0)
    last = np.array(COUNT)[:, None] - 1.0
    ratios = np.array(LOW)[:, None] + np.array(STEP)[:, None] * rng.uniform(0.0, last, (4, 20_000))
    for ours, exact in zip(looked_up(ratios), closed_form(ratios), strict=True):
        assert np.abs(ours / exact - 1.0).max() < TOLERANCE


@pytest.mark.parametrize(
    ("stiffness", "length", "mass", "hertz", "tip"),
    [
        ((10.0, 5.0), (1.0, 1.0), (1.0, 0.5), 0.3809, 0.6),
        ((10.0, 1.0), (1.0, 1.0), (1.0, 0.5), 0.2954, 1.4),
        ((20.0, 10.0), (1.0, 0.5), (1.0, 0.25), 0.8225, 0.1375),
    ],
)
def test_three_pairs_with_known_modes(
    stiffness: tuple[float, float],
    length: tuple[float, float],
    mass: tuple[float, float],
    hertz: float,
    tip: float,
) -> None:
    table = pair_table()
    ratio = stiffness[1] / stiffness[0], length[1] / length[0], 0.0
    density = mass[1] / length[1] / (mass[0] / length[0])
    merged = stiffness[0] * look_up_stiffness(table.displacement, table.single, *ratio)
    assert sum(length) ** 2 / merged == pytest.approx(tip, rel=TOLERANCE)
    pair = Pairs(np.array([stiffness]), np.array([length]), np.array([mass]), np.zeros(1))
    rate = look_up_rate(table.rate, table.single, *ratio, density)
    frequency = rate * np.sqrt(stiffness[0] / pair.inertia[0])
    assert frequency / (2.0 * np.pi) == pytest.approx(hertz, rel=TOLERANCE)
    # And the motion itself, under a wind that moves the tip by 1 % of the pair's length.
    force = 0.01 * sum(length) / tip
    displacement, swing = swing_pairs(pair, force)
    assert displacement[0] == pytest.approx(force * tip, rel=1e-3)
    assert swing[0] / (2.0 * np.pi) == pytest.approx(hertz, rel=1e-3)


def test_a_far_swing_stands_out_less_than_the_closed_form() -> None:
    # One link: k x = F L cos(x), tip at L sin(x).
    pair = Pairs(np.array([[1.0, 1e6]]), np.ones((1, 2)), np.ones((1, 2)), np.zeros(1))
    turn = 0.5
    displacement, _ = swing_pairs(pair, turn / (2.0 * np.cos(turn)))
    assert displacement[0] == pytest.approx(2.0 * np.sin(turn), rel=1e-4)


def test_some_nodes_made_again_are_those_shipped() -> None:
    table = pair_table()
    node = np.random.default_rng(1).integers(0, np.array(COUNT)[:, None], (4, 60))
    displacement, rate = simulated_nodes(node)
    i, j, k, l = node  # noqa: E741
    assert np.abs(rate - table.rate[i, j, k, l]).max() < 2e-5
    # The table keeps the displacement of the lightest child: at rest, mass does not matter.
    assert np.abs(displacement - table.displacement[i, j, k]).max() < 2e-5


def test_two_uniform_rods_stand_for_themselves() -> None:
    angle, length, mass = 0.6, (0.8, 2.0), (1.0, 1.2)
    pair = Pairs(np.ones((1, 2)), np.array([length]), np.array([mass]), np.array([angle]))
    inertia_c = mass[1] * length[1] ** 2 / 3.0
    moments = pair.inertia[0], 0.5 * mass[1] * length[1], inertia_c
    ratio, density, share = equal_rods(length[0], angle, *moments)
    assert ratio == pytest.approx(length[1] / length[0])
    assert density == pytest.approx(mass[1] / length[1] / (mass[0] / length[0]))
    assert share == pytest.approx(inertia_c / pair.inertia[0])


def test_a_pair_unlike_any_rods_is_held_at_the_densest_child() -> None:
    # All of the child's mass at its tip, and none in the parent.
    ratio, density, share = equal_rods(1.0, 0.0, 4.0, 1.0, 1.0)
    assert ratio == pytest.approx(1.5)
    assert density == pytest.approx(np.exp(LOW[3] + STEP[3] * (COUNT[3] - 1)))
    assert 0.2 < share < 0.3


def test_beyond_its_edges_the_table_is_held() -> None:
    table = pair_table()
    edge = np.array(LOW) + np.array(STEP) * (np.array(COUNT) - 1)
    (stiffness, length, angle, density), far = edge, edge + 3.0
    for low, low_far in ((LOW[0], LOW[0] - 3.0), (stiffness, far[0])):
        at = look_up_rate(table.rate, table.single, *np.exp([low, length]), angle, np.exp(density))
        beyond = look_up_rate(table.rate, table.single, *np.exp([low_far, far[1]]), far[2], np.exp(far[3]))
        assert beyond == pytest.approx(at, rel=1e-9)


def test_the_command_writes_the_table_that_the_package_reads(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("windswept.levels.pair_table.make_pair_table", pair_table)
    write_pair_table(tmp_path / "again.npz")
    shipped = Path(write_pair_table.__defaults__[0])  # type: ignore[index]
    # Python's versions write the heads of a zip file in their own ways; the numbers are the same.
    with np.load(shipped) as stored, np.load(tmp_path / "again.npz") as again:
        assert sorted(stored) == sorted(PairTable.__slots__) == sorted(again)
        assert all(np.array_equal(stored[name], again[name]) for name in stored)

"""Metrics: what an error of a level is."""

from __future__ import annotations

import numpy as np
import pytest

from handmade import random_tree
from windswept.levels import build_ladder, measure, simplify
from windswept.levels.metrics import METRICS
from windswept.motion import build_model


@pytest.fixture
def tracks() -> tuple[np.ndarray, np.ndarray]:
    """(2, 3, 40, 3) tips of three plants at two levels, now and before."""
    rng = np.random.default_rng(0)
    return rng.normal(0.0, 1.0, (2, 3, 40, 3)), rng.normal(0.0, 1.0, (2, 3, 40, 3))


@pytest.mark.parametrize("name", sorted(METRICS))
def test_a_level_has_no_error_against_itself(name: str, tracks: tuple[np.ndarray, np.ndarray]) -> None:
    now, before = (np.broadcast_to(track[:1], track.shape) for track in tracks)
    error = METRICS[name].between(now, before, 0.1)
    assert not error.any()
    assert (METRICS[name].between(*tracks, 0.1)[1] > 0.0).any()


def test_a_shift_is_an_error_of_place_and_outline_but_not_of_velocity(
    tracks: tuple[np.ndarray, np.ndarray],
) -> None:
    shift = np.array([0.3, 0.0, 0.0])
    now, before = (np.stack([track[0], track[0] + shift]) for track in tracks)
    assert METRICS["displacement"].between(now, before, 0.1)[1] == pytest.approx(0.3)
    assert METRICS["velocity"].between(now, before, 0.1)[1] == pytest.approx(0.0, abs=1e-12)
    assert METRICS["silhouette"].between(now, before, 0.1)[1].max() == pytest.approx(0.3)


def test_an_exchange_of_tips_does_not_change_the_outline(tracks: tuple[np.ndarray, np.ndarray]) -> None:
    now = np.stack([tracks[0][0], tracks[0][0][:, ::-1]])
    assert not METRICS["silhouette"].between(now, now, 0.1).any()
    assert METRICS["displacement"].between(now, now, 0.1)[1].max() > 0.1


def test_a_tip_that_lags_has_an_error_of_velocity() -> None:
    before = np.zeros((2, 1, 1, 3))
    now = np.array([[[[0.2, 0.0, 0.0]]], [[[0.1, 0.0, 0.0]]]])
    assert METRICS["velocity"].between(now, before, 0.1)[1] == pytest.approx(1.0)


def test_measured_in_any_metric_still_is_the_worst_or_nearly() -> None:
    ladder = build_ladder(simplify(build_model(random_tree(7))))
    for name in METRICS:
        measured = measure(ladder, 3.0, metric=name)
        assert measured.rms[0] == 0.0
        assert (measured.rms[1:] > 0.0).all()
        assert measured.rms[-1] >= 0.5 * measured.rms.max()

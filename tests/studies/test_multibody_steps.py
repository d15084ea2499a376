"""The study of the steps of `multibody`."""

from __future__ import annotations

import pytest

from windswept.studies import multibody_steps


def test_wheat_is_near_the_truth_and_rests(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(multibody_steps, "SECONDS", 2.0)
    monkeypatch.setattr(multibody_steps, "FINER", 8)
    monkeypatch.setattr(multibody_steps, "RATES", (120.0, 480.0))
    wheat, swung, swung_wide = multibody_steps.rows(["wheat"])
    assert 0.0 < wheat["training_error"] < 0.002
    assert wheat["training_error"] < wheat["maximal_error"] < 0.02
    assert max(wheat["rates_in_storms_rad_s"][:3]) < 1e-3
    assert wheat["sway_error"] < 0.01
    for rate in ("120 Hz", "480 Hz"):
        # What a gently swinging tree loses without damping is what SETTLING takes of its modes.
        left, expected = (
            swung[name][rate] for name in ("energy_left_after_a_minute", "settling_alone_leaves")
        )
        assert 0.1 < left < 1.0
        assert left == pytest.approx(expected, abs=1e-3)
        assert swung_wide["energy_left_after_a_minute"][rate] < left

"""The study of the steps of `multibody`."""

from __future__ import annotations

import pytest

from windswept.studies import multibody_steps


def test_wheat_is_near_the_truth_and_rests(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(multibody_steps, "SECONDS", 2.0)
    monkeypatch.setattr(multibody_steps, "RATES", (120.0,))
    wheat, swung = multibody_steps.rows(["wheat"])
    assert 0.0 < wheat["training_error"] < 0.002
    assert wheat["training_error"] < wheat["maximal_error"] < 0.02
    assert max(wheat["rates_in_storms_rad_s"][:3]) < 1e-3
    assert 0.1 < swung["energy_left_after_a_minute"]["120 Hz"] < 1.0

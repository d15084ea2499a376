"""The study of velocity terms."""

from __future__ import annotations

from windswept.studies.multibody_velocity_terms import row


def test_velocity_terms_matter_little_and_more_in_more_wind() -> None:
    gentle, strong = (row(speed, 2.0) for speed in (3.0, 14.0))
    assert 0.0 < gentle["over_motion"] < strong["over_motion"] < 0.02
    assert gentle["over_motion"] < gentle["over_sway"]

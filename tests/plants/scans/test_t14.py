"""Scan T14 (Jackson et al. 2019): our frequencies against beams on the same cylinders, and beside the field's.

The scan is not part of the repository; its folder is found by WINDSWEPT_DATA, or beside the repository.
"""

import os
from pathlib import Path

import numpy as np
import pytest

from frame_elements import frame_frequencies, frame_of_cylinders
from windswept.motion.modes import plant_frequencies
from windswept.motion.rods import build_rods
from windswept.motion.skeleton import build_skeleton
from windswept.plants.plant import Plant
from windswept.plants.scans import grow_scan

FOLDER = Path(os.environ.get("WINDSWEPT_DATA", Path(__file__).parents[4] / "shared" / "data"))
SCAN = FOLDER / "T14_cylinders.csv"
PUBLISHED = np.array([0.198, 0.198, 0.462, 0.478, 0.482])
"""Frame model of PHYSICS part 3, Hz."""

pytestmark = pytest.mark.skipif(not SCAN.is_file(), reason="the scan T14 is not here (WINDSWEPT_DATA)")


def frequencies(plant: Plant) -> np.ndarray:
    return plant_frequencies(build_skeleton(plant), build_rods(plant), 5)


@pytest.fixture(scope="module")
def frame():
    table = np.loadtxt(SCAN, delimiter=",", skiprows=1, usecols=range(9))
    return frame_of_cylinders(table)


@pytest.fixture(scope="module")
def bare():
    return grow_scan(SCAN, leaf_area=0.0)[0]


def test_the_reference_gives_the_published_frequencies(frame) -> None:
    assert frame_frequencies(frame) == pytest.approx(PUBLISHED, rel=0.01)


def test_ours_against_the_reference(frame, bare) -> None:
    ours, reference = frequencies(bare), frame_frequencies(frame)
    print(f"ours {ours.round(4)}, beams {reference.round(4)} Hz")
    assert ours[0] == pytest.approx(reference[0], rel=0.05)
    assert ours == pytest.approx(reference, rel=0.10)


def test_what_is_left_is_torsion(frame, bare) -> None:
    # Our joints bend and do not twist; beams that do not twist either ring as ours do.
    assert frequencies(bare) == pytest.approx(frame_frequencies(frame, torsion=1e3), rel=0.025)


def test_leaves_lower_the_frequency(bare) -> None:
    leafy, report = grow_scan(SCAN)
    ratio = frequencies(bare)[0] / frequencies(leafy)[0]
    print(
        f"bare over in leaf {ratio:.3f} with {leafy.leaf_area.sum():.0f} m^2; in the field 0.242 / 0.188 = 1.29"
    )
    assert 1.05 < ratio < 1.4
    assert frequencies(leafy)[0] == pytest.approx(0.188, rel=0.4)
    assert frequencies(bare)[0] == pytest.approx(0.242, rel=0.4)
    assert any("axes normalised (174)" in line for line in report.repaired)

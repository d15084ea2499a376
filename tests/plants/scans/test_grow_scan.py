"""Scans become plants: joining, repairs, leaves, formats."""

from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat

from windswept.motion.modes import plant_frequencies
from windswept.motion.rods import build_rods
from windswept.motion.skeleton import build_skeleton
from windswept.plants.plant import Plant
from windswept.plants.scans import grow_scan
from windswept.plants.scans.leaves import usual_leaf_area

from .scan_files import fork, write_csv  # isort: skip


def same(first: Plant, second: Plant) -> bool:
    names = [name for name in first.__dataclass_fields__ if name.split("_")[0] in ("stem", "link", "leaf")]
    return all(getattr(first, name).tobytes() == getattr(second, name).tobytes() for name in names)


@pytest.fixture
def scan(tmp_path):
    def make(table, header=None, **options):
        path = write_csv(tmp_path / "scan.csv", table, *([] if header is None else [header]))
        return grow_scan(path, **options)

    return make


def test_a_fork(scan) -> None:
    plant, report = scan(fork(), leaf_area=0.0)
    assert plant.stem_order.tolist() == [0, 1]
    assert plant.link_base[0].tolist() == [0.0, 0.0, 0.0]
    assert plant.height == pytest.approx(3.0)
    seat = plant.link_base[plant.stem_link_start[1]]
    assert seat == pytest.approx([0.0, 0.0, 1.4], abs=1e-6)
    assert plant.link_tip[-1] == pytest.approx([1.6, 0.0, 2.6], abs=1e-6)
    assert not report.repaired
    assert plant.leaf_count == 0


def test_a_child_near_an_end_of_its_parent_starts_at_the_end(scan) -> None:
    table = fork()
    table[3, 4] = 3.985
    plant, _ = scan(table, leaf_area=0.0)
    assert plant.link_base[plant.stem_link_start[1], 2] == pytest.approx(2.0)


def test_repairs_are_told_and_change_nothing_else(scan) -> None:
    clean, _ = scan(fork(), leaf_area=0.0)
    table = fork()
    table[:, 5:8] *= 1.7
    table[[0, 4]] = table[[4, 0]]
    table[:, 8] = [4, 5, 2, 2, 0]
    mended, report = scan(table, leaf_area=0.0)
    assert same(clean, mended)
    assert "axes normalised (5)" in report.repaired
    assert any(line.startswith("parents stood after their children") for line in report.repaired)


def test_gaps_are_closed_and_thick_children_reported(scan) -> None:
    table = fork()
    table[3, 2] += 0.2
    table[2, 0] = 0.09
    plant, report = scan(table, leaf_area=0.0)
    assert "gaps closed (2)" in report.repaired
    assert "thicker than their parents, left as they are (1)" in report.repaired
    clamped, _ = scan(table, leaf_area=0.0, clamp_radii=True)
    assert plant.link_radius_base.max() == clamped.link_radius_base.max() == np.float32(0.1)
    assert (plant.link_radius_base == np.float32(0.09)).any()
    assert not (clamped.link_radius_base == np.float32(0.09)).any()


def test_several_roots(scan) -> None:
    table = fork()
    table[3, 8] = 0
    _, report = scan(table, leaf_area=0.0)
    assert "further roots joined (1)" in report.repaired
    table[3:, 2] += 30.0
    plant, report = scan(table, leaf_area=0.0)
    assert "far from the tree, left out (2)" in report.repaired
    table[3:, 2] -= 29.0
    table[3:, 4] -= 1.2
    plant, report = scan(table, leaf_area=0.0)
    assert "further roots on the ground kept as trunks (1)" in report.repaired
    assert (plant.stem_parent == -1).sum() == 2


@pytest.mark.parametrize(
    "header", ["", "Radius (m), Length (m), Sta_X, Sta_Y, Sta_Z, Ax_X, Ax_Y, Ax_Z, Parent"]
)
def test_headings_may_differ_or_lack(scan, header) -> None:
    assert same(scan(fork())[0], scan(fork(), header)[0])


def test_columns_are_found_by_name(tmp_path) -> None:
    table = fork()[:, [8, 5, 6, 7, 2, 3, 4, 1, 0]]
    header = "parent,axis_x,axis_y,axis_z,start_x,start_y,start_z,length,radius"
    shuffled = grow_scan(write_csv(tmp_path / "scan.csv", table, header))[0]
    assert same(shuffled, grow_scan(write_csv(tmp_path / "scan.csv", fork()))[0])


def test_matlab_files(tmp_path) -> None:
    table = fork()
    cylinder = {
        "radius": table[:, :1],
        "length": table[:, 1:2],
        "start": table[:, 2:5],
        "axis": table[:, 5:8],
    }
    cylinder["parent"] = table[:, 8:].astype(np.uint16)
    plants = []
    for content in ({"QSM": {"cylinder": cylinder}}, {"cylinder": cylinder}, {"CylData": table}):
        savemat(tmp_path / "scan.mat", content, do_compression=True)
        plants.append(grow_scan(tmp_path / "scan.mat")[0])
    assert all(same(plants[0], plant) for plant in plants)
    assert same(plants[0], grow_scan(write_csv(tmp_path / "scan.csv", table))[0])


@pytest.mark.parametrize(("angles", "mean"), [("spherical", 0.5), ("planophile", 8.0 / (3.0 * np.pi))])
def test_leaves_have_the_area_and_angles_asked_for(scan, angles, mean) -> None:
    plant, _ = scan(fork(), leaf_area=40.0, angles=angles)
    assert plant.leaf_area.sum() == pytest.approx(40.0, rel=1e-3)
    assert set(plant.link_stem[plant.leaf_link]) == {1}
    # Mean of |cos| over a sphere is 1/2; of cos over 2/pi (1 + cos 2a) from 0 to pi/2 it is 8 / (3 pi).
    assert plant.leaf_normal[:, 2].mean() == pytest.approx(mean, abs=0.02)


def test_leaves_follow_the_trunk_and_the_seed(scan) -> None:
    first, report = scan(fork())
    assert first.leaf_area.sum() == pytest.approx(usual_leaf_area(first), rel=0.01)
    assert any("leaf area" in line for line in report.defaulted)
    assert same(first, scan(fork())[0])
    other = scan(fork(), seed=1)[0]
    assert not same(first, other)
    np.testing.assert_array_equal(first.link_tip, other.link_tip)


def test_a_straight_scan_rings_as_a_beam(tmp_path: Path) -> None:
    rows = [[0.05, 1.0, 0, 0, i, 0, 0, 1, i] for i in range(6)]
    plant, _ = grow_scan(write_csv(tmp_path / "pole.csv", np.array(rows, float)), leaf_area=0.0)
    expected = 1.8751**2 / (2 * np.pi) * 0.025 / 36.0 * np.sqrt(9.5e9 / 800.0)
    assert plant_frequencies(build_skeleton(plant), build_rods(plant), 1)[0] == pytest.approx(
        expected, rel=0.01
    )

"""OBJ files: whole meshes in metres, +Z up."""

import numpy as np
import pytest

from windswept.errors import InputError
from windswept.export.obj import export_obj
from windswept.plants.weber_penn import grow


def read_obj(path):
    """Vertices, and faces by group."""
    vertices, groups = [], {}
    for line in path.read_text().splitlines():
        kind, *words = line.split()
        if kind == "v":
            vertices.append([float(word) for word in words])
        elif kind == "g":
            faces = groups.setdefault(words[0], [])
        elif kind == "f":
            faces.append([int(word) - 1 for word in words])
    return np.array(vertices), {name: np.array(faces) for name, faces in groups.items()}


def test_a_plant_at_rest(tmp_path) -> None:
    plant = grow("hazel", seed=1)
    export_obj(plant, tmp_path / "hazel.obj")
    vertices, groups = read_obj(tmp_path / "hazel.obj")
    assert list(groups) == ["bark", "leaves"]
    assert np.isfinite(vertices).all()
    assert vertices[:, 2].max() == pytest.approx(plant.height, abs=0.2)
    used = np.concatenate([faces.ravel() for faces in groups.values()])
    assert set(used) == set(range(len(vertices)))
    assert len(groups["leaves"]) == 2 * plant.leaf_count
    corners = vertices[groups["leaves"]]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = 0.5 * np.linalg.norm(across, axis=1).sum()
    assert area == pytest.approx(plant.leaf_area.sum(), rel=0.35)


def test_bark_faces_look_outwards(tmp_path) -> None:
    export_obj(grow("lombardy_poplar"), tmp_path / "poplar.obj")
    vertices, groups = read_obj(tmp_path / "poplar.obj")
    corners = vertices[groups["bark"][:200]]
    outward = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    middle = corners.mean(axis=1)
    low = middle[:, 2] < 1.0
    assert (np.einsum("ij,ij->i", outward[low, :2], middle[low, :2]) > 0).mean() > 0.95


def test_same_bytes_twice_and_nothing_left_behind(tmp_path) -> None:
    for name in ("one.obj", "two.obj"):
        export_obj(grow("wheat"), tmp_path / name)
    assert (tmp_path / "one.obj").read_bytes() == (tmp_path / "two.obj").read_bytes()
    with pytest.raises(InputError, match="a folder that exists"):
        export_obj(grow("wheat"), tmp_path / "none" / "a.obj")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["one.obj", "two.obj"]

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from shaken import shaken_pose
from windswept.gpu.frame import Camera, Frame, PosedPlants
from windswept.gpu.renderer import Renderer


def brightness(picture):
    return picture[..., :3].astype(float).mean(axis=2)


def test_a_picture_has_sky_above_and_ground_below(stand):
    picture = stand.renderer.draw(stand.frame(camera=Camera((0.0, -60.0, 2.0), (0.0, 0.0, 2.0))))
    assert picture.shape == (96, 160, 4)
    assert (picture[..., 3] == 255).all()
    sky, ground = picture[:8].astype(float).mean((0, 1)), picture[-8:].astype(float).mean((0, 1))
    assert sky[2] > sky[0]
    assert ground[1] > ground[2]


def test_the_same_frame_gives_the_same_picture(stand):
    frame = stand.frame(time=2.0, wind=(4.0, 1.0), flutter=0.2)
    np.testing.assert_array_equal(stand.renderer.draw(frame), stand.renderer.draw(frame))


def test_plants_are_seen_to_move(stand):
    calm = stand.renderer.draw(stand.frame()).astype(int)
    poses = [shaken_pose(plant, 3, angle=0.3) for plant in stand.plants]
    moved = stand.renderer.draw(stand.frame(poses)).astype(int)
    assert (np.abs(calm - moved).max(axis=2) > 20).mean() > 0.005


def test_grass_sways_only_in_wind(stand):
    camera = Camera((0.0, -40.0, 1.2), (0.0, -35.0, 0.0))
    calm = [stand.renderer.draw(stand.frame(camera=camera, time=t)) for t in (0.0, 1.0)]
    windy = [stand.renderer.draw(stand.frame(camera=camera, time=t, wind=(6.0, 0.0))) for t in (0.0, 1.0)]
    np.testing.assert_array_equal(*calm)
    assert (windy[0] != windy[1]).any()


def test_a_tree_throws_its_shadow_away_from_the_sun(stand):
    """Seen from straight above with the sun in the west, the ground east of a trunk is darker."""
    camera = Camera((0.5, 1.0, 30.0), (0.5, 1.0, 0.0), 0.4)
    west = brightness(stand.renderer.draw(stand.frame(camera=camera, sun=(-1.0, 0.0, 0.6))))
    east = brightness(stand.renderer.draw(stand.frame(camera=camera, sun=(1.0, 0.0, 0.6))))
    difference = west - east
    columns = np.arange(160)
    darker_from_west = -np.minimum(difference, 0.0).sum(axis=0)
    darker_from_east = np.maximum(difference, 0.0).sum(axis=0)
    centre_west = (columns * darker_from_west).sum() / darker_from_west.sum()
    centre_east = (columns * darker_from_east).sum() / darker_from_east.sum()
    assert centre_west > centre_east + 2.0


@pytest.mark.parametrize("size", [(64, 48), (100, 30)])
def test_pictures_follow_a_new_size(stand, size):
    before = stand.renderer.size
    stand.renderer.resize(size)
    assert stand.renderer.draw(stand.frame()).shape == (size[1], size[0], 4)
    stand.renderer.resize(before)


def test_looking_straight_down_and_away_from_everything(stand):
    for camera in (Camera((0, 0, 20), (0, 0, 0)), Camera((0, -9, 2), (0, -90, 2))):
        picture = stand.renderer.draw(stand.frame(camera=camera))
        assert picture[..., :3].std() > 1.0


def test_a_meadow_without_plants_is_drawn(device):
    renderer = Renderer([], [], size=(64, 48))
    picture = renderer.draw(Frame((), Camera((0.0, -9.0, 2.0), (0.0, 0.0, 1.0))))
    assert picture[..., :3].std() > 5.0


def test_a_kind_without_placements_is_no_trouble(stand):
    frame = stand.frame()
    fields = ("link", "position", "yaw", "flutter")
    none = PosedPlants(*(getattr(frame.plants[1], name)[:0] for name in fields))
    picture = stand.renderer.draw(replace(frame, plants=(frame.plants[0], none)))
    assert (picture != stand.renderer.draw(frame)).any()

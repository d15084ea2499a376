from __future__ import annotations

from pathlib import Path

import av
import numpy as np
import pytest
from PIL import Image

from windswept.errors import GraphicsError, InputError
from windswept.gpu.frame import Camera
from windswept.render.film import check_film
from windswept.render.offscreen import write_png
from windswept.render.orbit import orbit_from
from windswept.render.video import write_video
from windswept.render.window import require_window


def pictures(count, height=34, width=50):
    for k in range(count):
        picture = np.full((height, width, 4), 255, np.uint8)
        picture[:, : 5 * k + 5, :2] = 40
        yield picture


def test_a_png_holds_the_picture(tmp_path):
    picture = next(pictures(1))
    write_png(picture, tmp_path / "a.png")
    np.testing.assert_array_equal(np.asarray(Image.open(tmp_path / "a.png")), picture[..., :3])


@pytest.mark.parametrize("ending", [".mp4", ".webp"])
def test_a_video_holds_every_frame(tmp_path, ending):
    path, done = tmp_path / f"a{ending}", []
    write_video(pictures(6), path, 25.0, done.append)
    if ending == ".mp4":
        with av.open(str(path)) as container:
            frames = [frame.to_ndarray(format="rgb24") for frame in container.decode(video=0)]
            assert container.streams.video[0].average_rate == 25
    else:
        with Image.open(path) as image:
            frames = [np.zeros((image.height, image.width, 3))] * image.n_frames
    assert len(frames) == 6
    assert frames[0].shape == (34, 50, 3)
    assert done == [1, 2, 3, 4, 5, 6]
    assert [file.name for file in tmp_path.iterdir()] == [path.name]


@pytest.mark.parametrize("ending", [".mp4", ".webp"])
def test_an_interrupted_video_leaves_nothing_behind(tmp_path, ending):
    def interrupted():
        yield from pictures(3)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_video(interrupted(), tmp_path / f"a{ending}")
    assert list(tmp_path.iterdir()) == []


def test_bad_paths_are_named(tmp_path):
    with pytest.raises(InputError, match="webp"):
        write_video(pictures(2), tmp_path / "a.gif")
    with pytest.raises(InputError, match="at least one frame"):
        write_video(iter(()), tmp_path / "a.mp4")
    with pytest.raises(InputError, match="folder"):
        write_png(next(pictures(1)), tmp_path / "none" / "a.png")


def test_places_are_refused_before_any_work(tmp_path):
    (tmp_path / "v.mp4").mkdir()
    for path, said in (
        (tmp_path / "a.gif", "ends in .png, .mp4 or .webp"),
        (tmp_path / "v.mp4", "a file, not a folder"),
        (tmp_path / "none" / "a.png", "a folder that exists"),
        (Path("/proc/a.png"), "a place that can be written to"),
    ):
        with pytest.raises(InputError, match=said):
            check_film(path)
    check_film(tmp_path / "a.png")
    assert [file.name for file in tmp_path.iterdir()] == ["v.mp4"]


def test_what_goes_wrong_on_disk_is_one_line(tmp_path):
    (tmp_path / "a.png").mkdir()
    with pytest.raises(InputError, match="can be written to"):
        write_png(next(pictures(1)), tmp_path / "a.png")
    assert [file.name for file in tmp_path.iterdir()] == ["a.png"]


def test_odd_sizes_are_cut_to_even_ones(tmp_path):
    write_video(pictures(2, height=35, width=51), tmp_path / "a.mp4")
    with av.open(str(tmp_path / "a.mp4")) as container:
        assert next(container.decode(video=0)).to_ndarray(format="rgb24").shape == (34, 50, 3)


def test_a_window_without_a_display_says_so(monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    monkeypatch.delenv("WAYLAND_DISPLAY", raising=False)
    with pytest.raises(GraphicsError, match="DISPLAY"):
        require_window()


def test_an_orbit_starts_at_its_camera_and_keeps_its_distance():
    camera = Camera((3.0, -4.0, 2.0), (0.5, 0.0, 1.0), 0.6)
    orbit = orbit_from(camera)
    np.testing.assert_allclose(orbit.camera().eye, camera.eye, atol=1e-9)
    moved = orbit.turned(0.4, 0.2).camera()
    away = np.linalg.norm(np.subtract(moved.eye, moved.target))
    assert away == pytest.approx(orbit.distance)
    assert orbit.turned(0.0, 10.0).camera().eye[2] > moved.eye[2]
    assert orbit.zoomed(2.0).distance == pytest.approx(2.0 * orbit.distance)

"""Moving pictures: frames to MP4 (H.264) or animated WebP."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from itertools import chain
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from windswept.errors import InputError
from windswept.forms.files import written_whole
from windswept.gpu.frame import Frame
from windswept.gpu.renderer import Renderer

Picture = NDArray[np.uint8]

VIDEO_ENDINGS = (".mp4", ".webp")
MP4_QUALITY = "23"
"""x264's constant rate factor, its own default: leaves in wind take many bytes."""
WEBP_QUALITY = 80


def render_video(
    renderer: Renderer,
    frames: Iterable[Frame],
    path: Path,
    frame_rate: float = 30.0,
    progress: Callable[[int], None] | None = None,
) -> None:
    """Draw frames into a video file; the path's ending chooses the format.

    Args:
        renderer: draws them.
        frames: one after the other; taken one by one, so that a simulation can step in between.
        path: ends in .mp4 or .webp.
        frame_rate: frames a second.
        progress: called after every frame with the number of frames done.

    Raises:
        InputError: unknown ending, no frames, or a folder that does not exist.
    """
    write_video((renderer.draw(frame) for frame in frames), path, frame_rate, progress)


def write_video(
    pictures: Iterable[Picture],
    path: Path,
    frame_rate: float = 30.0,
    progress: Callable[[int], None] | None = None,
) -> None:
    """Write pictures (height, width, 4) to a video file; see `render_video`."""
    ending = path.suffix.lower()
    if ending not in VIDEO_ENDINGS:
        raise InputError(str(path), "", path.suffix, "a path that ends in .mp4 or .webp")
    stream = _counted(pictures, progress)
    first = next(stream, None)
    if first is None:
        raise InputError(str(path), "", 0, "at least one frame")
    write = _write_mp4 if ending == ".mp4" else _write_webp
    with written_whole(path) as partial:
        write(first, chain([first], stream), partial, frame_rate)


def _counted(pictures: Iterable[Picture], progress: Callable[[int], None] | None) -> Iterator[Picture]:
    for done, picture in enumerate(pictures, start=1):
        yield picture
        if progress is not None:
            progress(done)


def _write_mp4(first: Picture, pictures: Iterable[Picture], path: Path, frame_rate: float) -> None:
    import av

    # H.264 with halved colour resolution takes even sizes only.
    height, width = (side // 2 * 2 for side in first.shape[:2])
    with av.open(str(path), "w", options={"movflags": "faststart"}) as container:
        rate = Fraction(frame_rate).limit_denominator(1001)
        stream = container.add_stream("libx264", rate=rate)
        stream.width, stream.height, stream.pix_fmt = width, height, "yuv420p"
        stream.options = {"crf": MP4_QUALITY, "preset": "medium"}
        for picture in pictures:
            rgb = np.ascontiguousarray(picture[:height, :width, :3])
            container.mux(stream.encode(av.VideoFrame.from_ndarray(rgb, format="rgb24")))
        container.mux(stream.encode())


def _write_webp(first: Picture, pictures: Iterable[Picture], path: Path, frame_rate: float) -> None:
    from PIL import Image

    images = (Image.fromarray(np.ascontiguousarray(picture[..., :3])) for picture in pictures)
    with path.open("wb") as file:
        next(images).save(
            file,
            format="WEBP",
            save_all=True,
            append_images=images,
            duration=round(1000.0 / frame_rate),
            loop=0,
            quality=WEBP_QUALITY,
        )

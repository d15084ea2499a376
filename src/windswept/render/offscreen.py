"""Pictures without a window: one frame to a PNG file."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from windswept.errors import InputError
from windswept.forms.files import written_whole
from windswept.gpu.frame import Frame
from windswept.gpu.renderer import Renderer


def render_picture(renderer: Renderer, frame: Frame, path: Path) -> None:
    """Draw one frame into a PNG file.

    Raises:
        InputError: the path does not end in .png, or its folder does not exist.
    """
    write_png(renderer.draw(frame), path)


def write_png(picture: NDArray[np.uint8], path: Path) -> None:
    """Write a picture (height, width, 4) to a PNG file.

    Raises:
        InputError: the path does not end in .png, or its folder does not exist.
    """
    from PIL import Image

    if path.suffix.lower() != ".png":
        raise InputError(str(path), "", path.suffix, "a path that ends in .png")
    with written_whole(path) as partial:
        Image.fromarray(np.ascontiguousarray(picture[..., :3])).save(partial, compress_level=6)

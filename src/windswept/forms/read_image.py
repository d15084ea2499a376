"""read_grey: a grey image that a person names, as numbers from black = 0 to white = 1."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from windswept.errors import InputError
from windswept.forms.read_text import shown_path

Reals = NDArray[np.float64]

ENDINGS = (".png", ".tif", ".tiff")
SMALLEST, LARGEST = 2, 8192
"""Pixels a side."""
GREYS = {"L": 255.0, "I;16": 65535.0, "I;16B": 65535.0, "I;16L": 65535.0, "I": 65535.0, "F": 1.0}
"""White of each of Pillow's grey modes; a PNG of 16 bit may come as I."""
KINDS = {"1": "black and white", "P": "with a palette", "RGB": "in colour", "RGBA": "in colour"}
NO_DATA_TAG = 42113
"""GDAL's TIFF tag for the value that stands for no data."""
WANTED = "a grey image of 8 or 16 bit (PNG or TIFF)"


@dataclass(frozen=True, slots=True)
class GreyImage:
    """R x C grey pixels."""

    grey: Reals
    """(R, C) 0 black to 1 white, the first row at the top."""
    step: float
    """Difference of neighbouring grey levels; 0 for floating point."""


def read_grey(path: Path) -> GreyImage:
    """Pixels of a grey PNG or TIFF file of 8 or 16 bit, or of a floating-point TIFF of values from 0 to 1.

    Raises:
        InputError: no such file, no image, a wrong kind or size, or pixels without a value.
    """
    source = shown_path(path)
    if path.suffix.lower() not in ENDINGS:
        raise InputError(source, "", path.suffix, f"{WANTED}, a path that ends in {', '.join(ENDINGS)}")
    if not path.is_file():
        raise InputError(source, "", None, "a file that exists")
    pixels, mode, opaque = _decode(source, path)
    grey = pixels / GREYS[mode]
    _check_holes(source, opaque & np.isfinite(grey))
    if grey.min() < 0.0 or grey.max() > 1.0:
        span = f"{pixels.min():g} to {pixels.max():g}"
        raise InputError(
            source, "", None, f"{WANTED}: its values go from {span}, not from 0 to {GREYS[mode]:g}"
        )
    return GreyImage(grey, 0.0 if mode == "F" else 1.0 / GREYS[mode])


def _decode(source: str, path: Path) -> tuple[Reals, str, NDArray[np.bool_]]:
    """Pixel values, Pillow's grey mode of them, and which pixels have a value."""
    from PIL import Image

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            image: Any = Image.open(path)
        with image:
            _check_size(source, *image.size)
            if image.mode not in GREYS and image.mode != "LA":
                kind = KINDS.get(image.mode, f"of mode {image.mode}")
                raise InputError(source, "", None, f"{WANTED}: this one is {kind}")
            pixels = np.asarray(image)
            return _without_alpha(image, pixels)
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        reason = " ".join(str(error).split())[:80]
        raise InputError(source, "", None, f"{WANTED} that can be read ({reason})") from None


def _without_alpha(image: Any, pixels: NDArray[Any]) -> tuple[Reals, str, NDArray[np.bool_]]:
    """Pixel values, mode, and where they are opaque and not marked as no data."""
    if image.mode == "LA":
        return pixels[..., 0].astype(np.float64), "L", pixels[..., 1] == 255
    values = pixels.astype(np.float64)
    absent = image.info.get("transparency")
    if absent is None and hasattr(image, "tag_v2"):
        absent = _number(image.tag_v2.get(NO_DATA_TAG))
    return values, image.mode, np.ones(values.shape, bool) if absent is None else values != absent


def _number(text: object) -> float | None:
    """A tag's text as a number; None where it is none."""
    try:
        return float(str(text).strip("\0 "))
    except ValueError:
        return None


def _check_size(source: str, width: int, height: int) -> None:
    """Enough pixels to interpolate between, and not too many to hold."""
    if min(width, height) < SMALLEST or max(width, height) > LARGEST:
        expected = f"an image of {SMALLEST} to {LARGEST:,} pixels a side"
        raise InputError(source, "", f"{width} x {height}", expected)


def _check_holes(source: str, known: NDArray[np.bool_]) -> None:
    """Every pixel has a value."""
    if not known.all():
        row, column = np.argwhere(~known)[0].tolist()
        count = int(np.sum(~known))
        where = f"{count:,} of its pixels {'has' if count == 1 else 'have'} no value, the first in column {column}"
        raise InputError(source, "", None, f"an image without holes: {where}, row {row}")

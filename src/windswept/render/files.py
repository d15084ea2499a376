"""Files that appear under their own name only once they are complete."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from windswept.errors import InputError


@contextmanager
def written_whole(path: Path) -> Iterator[Path]:
    """Temporary neighbour of ``path`` to write to; renamed at the end, or removed if anything goes wrong.

    Raises:
        InputError: the folder does not exist.
    """
    if not path.parent.is_dir():
        raise InputError(str(path), "", str(path.parent), "a folder that exists")
    partial = path.with_name(f".{path.stem}.partial{path.suffix}")
    try:
        yield partial
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)

"""Files that appear under their own name only once they are complete."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from windswept.errors import InputError


def check_place(path: Path, endings: tuple[str, ...]) -> None:
    """Refuses a path that cannot become a file of one of some endings, before any work is done.

    Raises:
        InputError: another ending, a folder of that name, or a folder that is not there or cannot be written to.
    """
    if path.suffix.lower() not in endings:
        raise InputError(str(path), "", path.suffix, f"a path that ends in {_either(endings)}")
    if path.is_dir():
        raise InputError(str(path), "", None, "a file, not a folder")
    folder = path.absolute().parent
    if not folder.is_dir():
        raise InputError(str(path), "", str(path.parent), "a folder that exists")
    try:
        # Asking for permissions is not enough: root has them in /proc as well, and nothing can be made there.
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        raise _unwritable(path, error) from None


@contextmanager
def written_whole(path: Path) -> Iterator[Path]:
    """Temporary neighbour of ``path`` to write to; renamed at the end, or removed if anything goes wrong.

    Raises:
        InputError: the folder does not exist, or the file cannot be written.
    """
    if not path.parent.is_dir():
        raise InputError(str(path), "", str(path.parent), "a folder that exists")
    partial = path.with_name(f".{path.stem}.partial{path.suffix}")
    try:
        yield partial
        partial.replace(path)
    except OSError as error:
        raise _unwritable(path, error) from error
    finally:
        with suppress(OSError):
            partial.unlink(missing_ok=True)


def _unwritable(path: Path, error: OSError) -> InputError:
    return InputError(str(path), "", None, f"a place that can be written to ({error.strerror or error})")


def _either(words: tuple[str, ...]) -> str:
    return " or ".join(filter(None, (", ".join(words[:-1]), words[-1])))

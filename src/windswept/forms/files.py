"""Files that appear under their own name only once they are complete."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from windswept.errors import InputError


def check_place(path: Path, endings: tuple[str, ...], option: str = "") -> None:
    """Refuses a path that cannot become a file of one of some endings, before any work is done.

    Args:
        path: of the file to be.
        endings: that it may have.
        option: of the command line that named it, for error messages; empty where a program did.

    Raises:
        InputError: another ending, a folder of that name, or a folder that is not there or cannot be written to.
    """
    if path.suffix.lower() not in endings:
        raise _refused(path, option, f"a path that ends in {_either(endings)}")
    if path.is_dir():
        raise _refused(path, option, "a file, not a folder")
    folder = path.absolute().parent
    if not folder.is_dir():
        raise _refused(path, option, _missing_folder(path))
    try:
        _try_folder(folder)
    except OSError as error:
        raise _refused(path, option, _writable(error)) from None


def make_folder(path: Path, option: str = "") -> None:
    """Makes a folder, and those that it lies in, where files are to be written.

    Args:
        path: of the folder.
        option: as in `check_place`.

    Raises:
        InputError: a file of that name, or a place that cannot be written to.
    """
    try:
        path.mkdir(parents=True, exist_ok=True)
        _try_folder(path)
    except (FileExistsError, NotADirectoryError):
        raise _refused(path, option, "a folder, not a file") from None
    except OSError as error:
        raise _refused(path, option, _writable(error)) from None


@contextmanager
def written_whole(path: Path) -> Iterator[Path]:
    """Temporary neighbour of ``path`` to write to; renamed at the end, or removed if anything goes wrong.

    Raises:
        InputError: the folder does not exist, or the file cannot be written.
    """
    if not path.parent.is_dir():
        raise InputError(str(path), "", None, _missing_folder(path))
    partial = path.with_name(f".{path.stem}.partial{path.suffix}")
    try:
        yield partial
        partial.replace(path)
    except OSError as error:
        raise InputError(str(path), "", None, _writable(error)) from error
    finally:
        with suppress(OSError):
            partial.unlink(missing_ok=True)


def _refused(path: Path, option: str, expected: str) -> InputError:
    return InputError(option or str(path), "", str(path) if option else None, expected)


def _missing_folder(path: Path) -> str:
    return f"a folder that exists: there is no {path.parent}"


def _writable(error: OSError) -> str:
    return f"a place that can be written to ({error.strerror or error})"


def _try_folder(folder: Path) -> None:
    """Writes a file that nobody sees: root has permissions in /proc as well, and nothing can be made there."""
    with tempfile.TemporaryFile(dir=folder):
        pass


def _either(words: tuple[str, ...]) -> str:
    return " or ".join(filter(None, (", ".join(words[:-1]), words[-1])))

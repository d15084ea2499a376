"""read_text: the text or the bytes of a file that a person names."""

from __future__ import annotations

from pathlib import Path

from windswept.errors import InputError


def read_text(path: Path, largest: int, noun: str) -> str:
    """UTF-8 text of a file, without the byte order mark that some editors write before it.

    Args:
        path: where it lies.
        largest: most bytes it may have.
        noun: what it should be, as "a species file".

    Raises:
        InputError: no such file, too large, or not UTF-8.
    """
    try:
        return read_bytes(path, largest, noun).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(shown_path(path), f"byte {error.start}", None, "UTF-8 text") from None


def read_bytes(path: Path, largest: int, noun: str) -> bytes:
    """Bytes of a file; arguments and errors as in `read_text`."""
    source = shown_path(path)
    try:
        if path.exists() and not path.is_file():
            raise InputError(source, "", None, f"{noun}, not a directory or a device")
        if path.stat().st_size > largest:
            raise InputError(source, "", None, f"{noun} of at most {largest:,} bytes")
        return path.read_bytes()
    except FileNotFoundError:
        raise InputError(source, "", None, "a file that exists") from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise InputError(source, "", None, f"a readable file ({reason})") from None


def shown_path(path: str | Path) -> str:
    """A path on one line."""
    return " ".join(str(path).splitlines())

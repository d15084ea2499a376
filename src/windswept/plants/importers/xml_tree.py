"""parse_xml: the elements of an XML file, malformed headers mended, entities refused."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import ParseError

from windswept.errors import InputError
from windswept.forms.read_text import read_bytes, shown_path

LARGEST_FILE = 4 << 20
"""Bytes."""
_HEADER = re.compile(rb"^\s*<\?xml.*?\?>", re.DOTALL)


def parse_xml(path: Path) -> tuple[Any, bool]:
    """Root element of an XML file, and whether its header had to be mended.

    Raises:
        InputError: it is not XML, or it declares entities or a document type.
    """
    from defusedxml import DefusedXmlException
    from defusedxml.ElementTree import fromstring

    source, data = shown_path(path), read_bytes(path, LARGEST_FILE, "an XML file")
    header = _HEADER.match(data)
    quoted = header is None or re.search(rb"version\s*=\s*[\"']", header[0])
    if header is not None and not quoted:
        data = data[header.end() :]
    try:
        return fromstring(data, forbid_dtd=False), not quoted
    except ParseError as error:
        line = error.position[0]
        raise InputError(
            source, f"line {line}", None, f"well-formed XML ({str(error).split(':')[0]})"
        ) from None
    except DefusedXmlException:
        raise InputError(source, "", None, "XML without entities or outside references") from None
    except (ValueError, LookupError, RecursionError) as error:
        raise InputError(source, "", None, f"XML text in UTF-8 ({str(error)[:60]})") from None

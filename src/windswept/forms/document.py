"""Tables of a document, made from a form so that the two never differ."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel

from windswept.forms.check_form import inner_form
from windswept.forms.words import field_words, is_list

BEGIN, END = "<!-- keys begin -->", "<!-- keys end -->"


def key_tables(form: type[BaseModel]) -> str:
    """Markdown: a heading and a table for every table of a file."""
    return "\n".join(_sections(form, ""))


def with_key_tables(text: str, form: type[BaseModel]) -> str:
    """A document with what stands between its marks replaced by ``key_tables``."""
    head, rest = text.split(BEGIN)
    return f"{head}{BEGIN}\n\n{key_tables(form)}\n{END}{rest.split(END)[1]}"


def _sections(form: type[BaseModel], path: str) -> list[str]:
    """Section of a form and of those inside it, depth first."""
    lines = [f"### {path or 'Top of the file'}", "", " ".join((form.__doc__ or "").split()), ""]
    lines += ["| key | what it takes | default | meaning |", "|---|---|---|---|"]
    inner: list[str] = []
    for name, field in form.model_fields.items():
        default = "**required**" if field.is_required() else _default(field.default)
        lines.append(f"| `{name}` | {field_words(field)} | {default} | {_meaning(field.description)} |")
        table = inner_form(field)
        if table is not None:
            name = f"{path.strip('[]')}.{name}".lstrip(".")
            inner += _sections(table, f"[[{name}]]" if is_list(field) else f"[{name}]")
    return [*lines, "", *inner]


def _meaning(description: str | None) -> str:
    """A description on one line."""
    return " ".join((description or "").split())


def _default(value: Any) -> str:
    """A default as a scene file would write it; empty where a left-out key is explained in words."""
    if value is None or isinstance(value, BaseModel | list):
        return ""
    if isinstance(value, tuple):
        return f"`[{', '.join(map(str, value))}]`"
    return f'`"{value}"`' if isinstance(value, str) else f"`{value}`"

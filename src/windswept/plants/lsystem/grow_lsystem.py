"""grow_lsystem: from a grammar to a plant."""

from __future__ import annotations

import re
from pathlib import Path

from windswept.errors import BudgetError, InputError
from windswept.forms.read_text import shown_path
from windswept.forms.words import nearest
from windswept.plants.depth_first import depth_first
from windswept.plants.lsystem.assemble import assemble
from windswept.plants.lsystem.derive import MODULE_BUDGET, Rewriter, derive
from windswept.plants.lsystem.form import GrammarForm, read_form
from windswept.plants.lsystem.interpret import interpret
from windswept.plants.lsystem.read_lpy import read_lpy
from windswept.plants.lsystem.read_system import read_system
from windswept.plants.lsystem.sketch import Sketch
from windswept.plants.lsystem.source_text import read_source
from windswept.plants.lsystem.system import System
from windswept.plants.lsystem.tidy import SHORTEST_LINK, tidy
from windswept.plants.lsystem.turtle import draw
from windswept.plants.plant import Plant
from windswept.plants.thicken import thicken
from windswept.plants.weber_penn.streams import Streams

TALLEST = 1000.0
"""Plants reach no farther from their root, m."""

_FOLDER = Path(__file__).parent / "grammars"


def grammar_names() -> list[str]:
    """Names of the built-in grammars, sorted."""
    return sorted(path.stem for path in _FOLDER.glob("*.l"))


def grow_lsystem(
    source: str | Path, seed: int = 0, module_budget: int = MODULE_BUDGET, link_budget: int = 300_000
) -> Plant:
    """Grow a plant from an L-system.

    Args:
        source: name of a built-in grammar, or path of a .l file in cpfg notation or of a declarative .lpy file.
        seed: 0 or more; the same grammar and seed give the same bytes.
        module_budget: most modules of the derived string.
        link_budget: most links the plant may have.

    Raises:
        InputError: the file or the seed is wrong; says the line.
        BudgetError: the string or the plant would be larger than a budget; says the step.
    """
    path = _find(source)
    if seed < 0:
        raise InputError("seed", "", seed, "a whole number from 0 up")
    name, text = shown_path(source), read_source(path)
    system = (read_lpy if path.suffix.lower() == ".lpy" else read_system)(text, name)
    species = re.sub(r"[^a-z0-9]+", "_", path.stem.lower()).strip("_") or "plant"
    return grow_system(system, read_form(path), species, seed, module_budget, link_budget)


def grow_system(
    system: System,
    form: GrammarForm,
    species: str,
    seed: int = 0,
    module_budget: int = MODULE_BUDGET,
    link_budget: int = 300_000,
) -> Plant:
    """Grow a plant from an L-system that has been read; arguments and errors as for `grow_lsystem`."""
    streams = Streams(system.seed + seed)
    word = derive(system, streams.generator("derivation"), module_budget)
    rewriter = Rewriter(system, streams.generator("interpretation"), module_budget)
    rewriter.step = system.steps
    sketch = draw(interpret(word, rewriter), system.reading, form.leaf_aspect, system.source)
    tidied = tidy(sketch, form.scale_m)
    _check_size(tidied, system, link_budget)
    return thicken(depth_first(assemble(tidied, form, species, seed)))


def _find(source: str | Path) -> Path:
    """Path of the file that a name or path means."""
    names = grammar_names()
    if isinstance(source, Path) or re.search(r"[/\\]|\.(l|lpy)$", source, re.I):
        return Path(source)
    if source in names:
        return _FOLDER / f"{source}.l"
    expected = f"a built-in grammar or the path of a .l or .lpy file: {nearest(source, names)}"
    raise InputError(shown_path(source) or "grammar", "", None, expected)


def _check_size(sketch: Sketch, system: System, link_budget: int) -> None:
    """Refuse plants without wood, too large in links, or too large in metres."""
    if not sketch.stems:
        expected = f"a grammar that draws wood of {SHORTEST_LINK * 1000:g} mm or more with F"
        raise InputError(system.source, f"step {system.steps}", None, expected)
    links = sum(len(stem.nodes) - 1 for stem in sketch.stems)
    if links > link_budget:
        where = f"{system.source}: step {system.steps} of {system.steps}"
        raise BudgetError(f"{where}: {links:,} links, budget {link_budget:,}: lower derivation length")
    reach = max(abs(value) for stem in sketch.stems for node in stem.nodes for value in node)
    if reach > TALLEST:
        expected = f"a plant within {TALLEST:g} m of its root: lower scale_m in the .toml beside the grammar"
        raise InputError(system.source, "", f"{reach:.0f} m", expected)

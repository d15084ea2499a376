"""Refuses trees that would be too large before their arrays are made."""

from __future__ import annotations

from windswept.errors import BudgetError
from windswept.plants.weber_penn.tree import Tree


def check_links(tree: Tree, count: int, order: int, key: str) -> None:
    """Raise BudgetError when the stems of one order alone need more links than the budget.

    Args:
        tree: what is grown.
        count: links of the plant so far, with those that are about to grow.
        order: branching order that is about to grow.
        key: parameter under [growth] to lower.
    """
    if count > tree.link_budget:
        what = f"stems of order {order} bring it to {count:,} links"
        raise BudgetError(_message(tree, what, tree.link_budget, key))


def check_leaves(tree: Tree, count: int) -> None:
    """Raise BudgetError when a plant would have more leaves than the budget."""
    if count > tree.leaf_budget:
        key = "leaf_quality or growth.leaves"
        raise BudgetError(_message(tree, f"it would have {count:,} leaves", tree.leaf_budget, key))


def _message(tree: Tree, what: str, budget: int, key: str) -> str:
    """One line that says what to lower."""
    return f"{tree.species.name}, seed {tree.seed}: {what}, budget {budget:,}: lower growth.{key}"

"""Random text is read or refused in one line; nothing else is raised and nothing hangs."""

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from windswept.errors import BudgetError, InputError
from windswept.plants.lsystem.form import GrammarForm
from windswept.plants.lsystem.grow_lsystem import grow_system
from windswept.plants.lsystem.read_lpy import read_lpy
from windswept.plants.lsystem.read_system import read_system
from windswept.plants.validate import validate

SETTINGS = settings(max_examples=400, deadline=2000, suppress_health_check=[HealthCheck.too_slow])

TOKENS = (
    *"FfGABCX+-&^\\/|[]{}.$!#_;,'%*()<>:=?~@\n\n",
    *("Axiom: ", "Axiom: F(1)", "derivation length: ", "derivation length: 4\n", "-->", " --> ", "(x)", "(x, y)"),
    *("F(x)", "A(x / 2)", "[+A(x)]", "[&(30)F(0.2)A(x)]", "~l(0.1)", "{.f.+f.}", "!(0.02)", "@K(2)", "@Ts(0.2)"),
    *(" : x > 0 ", " : 0.5\n", ": {y = x; if (y > 1) y = 2;} ", "ran(2)", "nran(0, 1)", "bran(0, 1)", "1e308"),
    *("sin(x)", "log(x)", "x ^ 9", "ignore: +-\n", "consider: A\n", "homomorphism\n", "decomposition\n"),
    *("maximum depth: 3\n", "#define x 3\n", "#define M(a) a a\n", "M(", "/*", "*/", "// ", "\\\n", "endlsystem"),
    *("Lsystem: 1\n", "Seed: 4\n", "elasticity: 0.2\n", "tropism direction: 0, 0, 1\n", "module A, Leaf\n", "x = 3\n"),
    *("def ", "import os\n", "A < B > C", "B[A]", '"', "0", "7", "1", " ", "ä", "\ue000"),
)  # fmt: skip

GRAMMAR = st.lists(st.sampled_from(TOKENS), max_size=40).map("".join)
RULES = st.lists(st.sampled_from(TOKENS), min_size=1, max_size=8).map("".join)
LIKELY = st.builds(
    lambda rules, axiom: (
        f"derivation length: 5\nAxiom: F(1){axiom}\n" + "\n".join(f"A(x) --> {r}" for r in rules)
    ),
    st.lists(RULES, max_size=3),
    st.sampled_from(["A(1)", "A(0)A(2)", "[+A(1)]A(3)", "!(0.1)A(1)"]),
)


def grown_or_refused(read, text):
    """Grow what a text says, unless it is refused as it should be."""
    try:
        plant = grow_system(
            read(text, "fuzz.l"), GrammarForm(), "fuzz", 1, module_budget=3000, link_budget=3000
        )
    except (InputError, BudgetError) as error:
        said = str(error)
    else:
        validate(plant)
        return
    assert "\n" not in said
    assert said.startswith("fuzz.l")
    assert len(said) < 400


@SETTINGS
@given(st.text(max_size=200))
def test_any_text(text):
    grown_or_refused(read_system, text)
    grown_or_refused(read_lpy, text)


@SETTINGS
@given(GRAMMAR)
def test_any_pieces_of_grammars(text):
    grown_or_refused(read_system, text)
    grown_or_refused(read_lpy, text)


@SETTINGS
@given(LIKELY)
def test_any_rules(text):
    grown_or_refused(read_system, text)

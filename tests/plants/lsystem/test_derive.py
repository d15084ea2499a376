"""Derivation against known strings and counts of The Algorithmic Beauty of Plants (ABOP)."""

import re

import pytest

from windswept.errors import BudgetError, InputError


def grammar(steps, axiom, *rules, before=""):
    return (
        f"{before}\nLsystem: 1\nderivation length: {steps}\nAxiom: {axiom}\n"
        + "\n".join(rules)
        + "\nendlsystem\n"
    )


def test_algae_grow_as_lindenmayer_says(derived):
    words = [derived(grammar(n, "A", "A --> AB", "B --> A")) for n in range(5)]
    assert words == ["A", "AB", "ABA", "ABAAB", "ABAABABA"]


def test_lengths_of_fibonacci(derived):
    lengths = [len(derived(grammar(n, "A", "A --> AB", "B --> A"))) for n in range(15)]
    assert all(c == a + b for a, b, c in zip(lengths, lengths[1:], lengths[2:], strict=False))
    assert lengths[14] == 987


@pytest.mark.parametrize("steps", range(6))
def test_bracketed_string_of_figure_1_24_a(derived, steps):
    word = derived(grammar(steps, "F", "F --> F[+F]F[-F]F"))
    assert word.count("F") == 5**steps
    assert word.count("[") == word.count("]") == 2 * (5**steps - 1) // 4


def test_doubling_internodes_of_figure_1_24_d(derived):
    n = 5
    word = derived(grammar(n, "X", "X --> F[+X]F[-X]+X", "F --> FF"))
    assert word.count("X") == 3**n
    # f(n) = 2 f(n-1) + 2 * 3^(n-1) with f(0) = 0
    assert word.count("F") == 2 * (3**n - 2**n)


def test_parametric_rules_and_conditions(derived):
    rules = [
        "A(x, y) : y <= 3 --> A(x * 2, x + y)",
        "A(x, y) : y > 3 --> B(x)A(x / y, 0)",
        "B(x) : x < 1 --> C",
    ]
    rules.append("B(x) : x >= 1 --> B(x - 1)")
    words = [derived(grammar(n, "B(2)A(4, 4)", *rules)) for n in range(5)]
    # the worked derivation of ABOP section 1.10.1, word for word
    assert words == ["B(2)A(4,4)", "B(1)B(4)A(1,0)", "B(0)B(3)A(2,1)", "CB(2)A(4,3)", "CB(1)A(8,7)"]


def test_a_rule_of_another_number_of_parameters_does_not_apply(derived):
    assert derived(grammar(1, "AA(1)A(1,2)", "A(x) --> B")) == "ABA(1,2)"


def test_signals_run_up_and_down(derived):
    up = [derived(grammar(n, "BAAAA", "B < A --> B", "B --> A")) for n in range(4)]
    assert up == ["BAAAA", "ABAAA", "AABAA", "AAABA"]
    down = [derived(grammar(n, "AAAAB", "A > B --> B", "B --> A")) for n in range(4)]
    assert down == ["AAAAB", "AAABA", "AABAA", "ABAAA"]


def test_left_context_passes_over_branches_and_enters_them(derived):
    word = derived(grammar(1, "J[+A]I[-A]A", "J < A --> B", "I < A --> C", before="ignore: + -"))
    assert word == "J[+B]I[-C]C"


def test_acropetal_and_basipetal_signals_of_abop_p_33(derived):
    axiom = "J[I]I[I]I[I]I"
    up = grammar(2, axiom, "J < I --> J")
    assert derived(up) == "J[J]J[J]J[I]I"
    down = grammar(2, "I[I]I[I]I[I]J", "I > J --> J")
    assert derived(down) == "I[I]J[I]J[I]J"


def test_context_with_branches_of_abop_p_32(derived):
    word = "ABC[DE][SG[HI[JK]L]MNO]"
    assert derived(grammar(1, word, "BC < S > G[H]M --> X")) == "ABC[DE][XG[HI[JK]L]MNO]"
    assert derived(grammar(1, word, "BC < S > G[I]M --> X")) == word


def test_context_passes_its_parameters(derived):
    rule = "A(x) < B(y) > C(z) --> B(x + 10 * y + 100 * z)"
    assert derived(grammar(1, "A(1)B(2)C(3)", rule)) == "A(1)B(321)C(3)"


def test_consider_is_the_inverse_of_ignore(derived):
    assert derived(grammar(1, "AXYB", "A < B --> C", before="consider: A B")) == "AXYC"
    assert derived(grammar(1, "AXYB", "A < B --> C")) == "AXYB"


@pytest.mark.parametrize(
    "rules",
    [
        ("A --> B : 0.2", "A --> C : 0.3", "A --> D : 0.5"),
        ("A -->0.2 B", "A -->.3 C", "A -->(0.5) D"),
        ("A --> B : 2", "A --> C : 3", "A --> D : 5"),
    ],
)
def test_probabilities_are_frequencies(derived, rules):
    word = derived(grammar(1, "A" * 20_000, *rules), seed=3)
    for symbol, share in zip("BCD", (0.2, 0.3, 0.5), strict=True):
        # four standard deviations of a binomial share
        assert word.count(symbol) / 20_000 == pytest.approx(
            share, abs=4 * (share * (1 - share) / 20_000) ** 0.5
        )


def test_probabilities_may_depend_on_parameters(derived):
    word = derived(grammar(1, "A(0)A(1)", "A(x) --> B : x", "A(x) --> C : 1 - x"))
    assert word == "CB"


def test_same_seed_same_string(derived):
    text = grammar(6, "A(1)", "A(x) --> B(ran(x))A(nran(1, 0.1)) : 0.7", "A(x) --> A(x)A(x) : 0.3")
    assert derived(text, 5) == derived(text, 5) != derived(text, 6)


def test_blocks_around_the_condition(derived):
    rule = "A(x) : {y = x * 2; if (y > 4) { z = 1; } else z = 0;} z == 1 {w = y; w += 1;} --> B(w)"
    assert derived(grammar(1, "A(1)A(3)", rule)) == "A(1)B(7)"


def test_macros_with_and_without_arguments(derived):
    before = "#define N 2\n#define TWICE(x) ((x) * N)\n#define RULE TWICE(TWICE(3))"
    assert derived(grammar("N", "A(RULE)", "A(x) --> A(TWICE(x + 1))", before=before)) == "A(54)"


def test_rules_and_axioms_over_several_lines_with_comments(derived):
    text = """/* first line
    second */
    Lsystem: 3
    derivation length: 1
    Axiom: A(1) /* there */
           B
    A(x) : x > 0 {
        y = x + 1;
    }
    --> C(y) // a comment
        D//E
        [F]
    B --> \\
       G
    ENDLSYSTEM this is never read ]]]"""
    assert derived(text) == "C(2)D//E[F]G"


def test_cut_removes_the_rest_of_its_branch(derived):
    assert derived(grammar(1, "A[BXC[D]E]F", "X --> %")) == "A[B]F"
    assert derived(grammar(1, "AXB[C]", "X --> %")) == "A"


def test_decomposition_goes_on_until_no_rule_applies(derived):
    rules = ["A --> T(3)", "decomposition", "T(n) : n > 0 --> BT(n - 1)", "T(n) : n == 0 --> *"]
    assert derived(grammar(1, "A", *rules)) == "BBB*"


def test_decomposition_keeps_to_its_maximum_depth(derived):
    rules = ["decomposition", "maximum depth: 2", "T --> BT"]
    assert derived(grammar(0, "T", *rules)) == "BBT"


def test_a_decomposition_without_end_is_stopped(derived):
    with pytest.raises(BudgetError, match="step 0 of 0: decomposition goes deeper than 1,000"):
        derived(grammar(0, "T", "decomposition", "T --> BT"))


def test_a_derivation_that_explodes_names_its_step(derived):
    with pytest.raises(BudgetError) as caught:
        derived(grammar(50, "A", "A --> AA"), budget=1000)
    assert re.fullmatch(
        r"test\.l: step 10 of 50: 1,002 modules, budget 1,000 modules: lower derivation length or raise the budget",
        str(caught.value),
    )


def test_a_long_derivation_of_a_long_string_is_stopped(derived):
    with pytest.raises(BudgetError, match=r"step 11 of 10000: 1,100 modules rewritten in all"):
        derived(grammar(10_000, "A" * 1000, "B --> C"), budget=1000)


def test_values_are_checked_where_they_arise(derived):
    with pytest.raises(
        InputError, match=r"test.l: line 5: expected an expression that has a value \(division by zero\)"
    ):
        derived(grammar(2, "A(1)", "A(x) --> A(1 / (x - 1))"))
    with pytest.raises(InputError, match=r"line 5 = -1\.0: expected a probability of 0 or more"):
        derived(grammar(1, "A", "A --> B : -1", "A --> C : 2"))

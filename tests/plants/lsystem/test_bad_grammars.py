"""Whatever is wrong with a file is said in one line with the file and the line."""

import time

import pytest

from windswept.errors import BudgetError, InputError
from windswept.plants.lsystem import grow_lsystem

HEAD = "Lsystem: 1\nderivation length: 2\nAxiom: F(1)A(1)\n"

BAD = {
    "empty": ("", "the file is empty"),
    "blank": ("\n  \n", "the file is empty"),
    "prose": ("This is a letter to a friend.\n", "line 1: expected a rule"),
    "no axiom": ("Lsystem: 1\nderivation length: 3\nA --> B\n", "an Axiom: line"),
    "nothing after the axiom": ("Lsystem: 1\nAxiom:\n", "line 2: expected modules after Axiom:"),
    "two axioms": (HEAD + "Axiom: B\n", "line 4: expected one Axiom: only"),
    "unclosed bracket": (HEAD + "A(x) --> F[+A(x)\n", "line 4: expected a closing ] for every ["),
    "bracket closed too soon": (HEAD + "A(x) --> F]+A(x)[\n", "line 4: expected an opening [ before every ]"),
    "unclosed polygon": (HEAD + "A(x) --> {.f.\n", "line 4: expected a closing } for every {"),
    "unclosed bracket in the axiom": ("Axiom: F[\n", "line 1: expected a closing ]"),
    "unclosed parenthesis": (HEAD + "A(x) --> F(x\n", "line 4: expected a rule"),
    "unclosed block": (HEAD + "A(x) : {y = 1; --> F(y)\n", "line 4: expected a rule"),
    "unclosed comment": (HEAD + "/* A --> B\n", "line 4: expected */"),
    "no successor arrow": (HEAD + "A(x) -> F(x)\n", "line 4: expected modules"),
    "unknown function": (HEAD + "A(x) --> F(sine(x))\n", "line 4: expected a known function, not sine"),
    "unknown name": (HEAD + "A(x) --> F(z)\n", "line 4: expected a known name, not z"),
    "unknown name in a condition": (HEAD + "A(x) : y > 2 --> F\n", "line 4: expected a known name, not y"),
    "wrong number of arguments": (HEAD + "A(x) --> F(pow(x))\n", "line 4: expected 2 arguments of pow, not 1"),
    "name twice": (HEAD + "A(x, x) --> F\n", "line 4: expected parameters of different names"),
    "two strict predecessors": (HEAD + "A B --> F\n", "line 4: expected one module to be rewritten"),
    "number for a parameter": (HEAD + "A(1) --> F\n", "line 4: expected a rule"),
    "division by zero": (HEAD + "A(x) --> A(x - 1)F(1 / x)\n", "line 4: expected an expression that has a value"),
    "update before assignment": (HEAD + "A(x) : {y += 1;} --> F(y)\n", "line 4: expected y to be assigned"),
    "second line of a rule": (HEAD + "A(x) --> F\n  [+F\n  F(q)]\n", "line 6: expected a known name, not q"),
    "length not a number": ("derivation length: soon\nAxiom: A\n", "line 1: expected a known name, not soon"),
    "length not whole": ("derivation length: 2.5\nAxiom: A\n", "line 1 = '2.5': expected a whole number from 0"),
    "length negative": ("derivation length: -1\nAxiom: A\n", "line 1 = '-1': expected a whole number from 0"),
    "length absurd": ("derivation length: 99999\nAxiom: A\n", "line 1 = '99999': expected a whole number"),
    "angle absurd": ("angle increment: 1e9\nAxiom: A\n", "line 1 = '1e9': expected a number from -360"),
    "tropism of two numbers": ("tropism direction: 0, 1\nAxiom: A\n", "line 1 = '0, 1': expected 3 numbers"),
    "context in a homomorphism": (HEAD + "homomorphism\nA < B --> C\n", "line 5: expected no context"),
    "include": ('#include "other.h"\n' + HEAD, "line 1: expected an L-system in cpfg notation; this is C"),
    "conditional compiling": ("#ifdef A\n" + HEAD, "line 1: expected no directive but #define"),
    "define without a name": ("#define\n" + HEAD, "line 1: expected no directive but #define"),
    "macros in a circle": ("#define A1 B1\n#define B1 A1 A1\nAxiom: F(A1)\n", "line 3: expected macros that come"),
    "macro without arguments": ("#define M(x) x\nAxiom: F(M)\n", "line 2: expected arguments in parentheses"),
    "macro of other arguments": ("#define M(x) x\nAxiom: F(M(1, 2))\n", "line 2: expected 1 arguments"),
    "blocks for all steps": (HEAD + "StartEach: {x = 1;}\n", "line 4: expected an L-system without"),
    "sub-L-systems": (HEAD + "Lsystem: 2\n", "line 4: expected one L-system in a file"),
    "query module": (HEAD + "A(x) --> F?P(0, 0, 0)\n", "line 4: expected a rule"),
    "no wood": ("Axiom: A+B~l(2)\n", "a grammar that draws wood"),
    "wood too short": ("Axiom: F(0.00001)\n", "a grammar that draws wood of 1 mm or more"),
    "too tall": ("Axiom: F(5000)\n", "= '5000 m': expected a plant within 1000 m"),
    "towers of parentheses": (f"Axiom: F({'(' * 500}1{')' * 500})\n", "line 1: expected parentheses at most 60"),
    "towers of signs": (f"Axiom: F({'-' * 5000}1)\n", "line 1: expected a shorter expression"),
    "endless sum": (HEAD + f"A(x) --> F({'x+' * 3000}x)\n", "line 4: expected"),
    "lpfg": ("#include <lpfgall.h>\nmodule A(float);\nAxiom: A(1);\n", "line 1: expected an L-system in cpfg"),
    "lpfg without its header": ("module A(float);\nAxiom: A(1);\nA(x):{produce F(x);}\n", "this is lpfg's C++"),
    "lex": ("%{\n#include <stdio.h>\n%}\n%%\n[0-9]+ return 1;\n%%\n", "this is a scanner for lex"),
    "lisp": ("(defun f (x) x)\n", "this is Lisp"),
    "gui": ("<?xml version='1.0'?><interface/>\n", "this is XML"),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_a_bad_file_gives_one_line(tmp_path, name):
    text, expected = BAD[name]
    path = tmp_path / "bad.l"
    path.write_text(text)
    started = time.perf_counter()
    with pytest.raises(InputError) as caught:
        grow_lsystem(path)
    message = str(caught.value)
    assert expected in message
    assert message.startswith(str(path))
    assert "\n" not in message
    assert len(message) < len(str(path)) + 260
    assert time.perf_counter() - started < 5


def test_files_that_are_no_text(tmp_path):
    path = tmp_path / "bad.l"
    path.write_bytes(b"Axiom: F\n\x00\x01\xff")
    with pytest.raises(InputError, match="byte 9: expected text, not a binary file"):
        grow_lsystem(path)
    with pytest.raises(InputError, match="expected an L-system, not a directory"):
        grow_lsystem(tmp_path)
    with pytest.raises(InputError, match="expected a file that exists"):
        grow_lsystem(tmp_path / "none.l")
    path.write_bytes(b"Axiom: F /* " + b"x" * (1 << 18) + b" */")
    with pytest.raises(InputError, match="of at most 262,144 bytes"):
        grow_lsystem(path)


def test_old_files_may_be_latin_1(tmp_path):
    path = tmp_path / "old.l"
    path.write_bytes("/* Gänseblümchen */\r\nAxiom: F(1)\r\n".encode("latin-1"))
    assert grow_lsystem(path).link_count == 8


def test_names_and_seeds():
    with pytest.raises(InputError, match="did you mean fern"):
        grow_lsystem("ferm")
    with pytest.raises(InputError, match="seed = -1: expected a whole number from 0 up"):
        grow_lsystem("fern", -1)


def test_a_bad_table_beside_a_grammar_is_named(tmp_path):
    path = tmp_path / "plant.l"
    path.write_text("Axiom: F(1)\n")
    path.with_suffix(".toml").write_text("scale_m = 0\n")
    with pytest.raises(InputError, match=r"plant.toml: scale_m = 0: expected a number"):
        grow_lsystem(path)
    path.with_suffix(".toml").write_text("scale = 1\n")
    with pytest.raises(InputError, match=r"plant.toml: scale: expected a known key"):
        grow_lsystem(path)


def test_budgets_of_modules_and_links(tmp_path):
    path = tmp_path / "plant.l"
    path.write_text("derivation length: 12\nAxiom: F(1)A\nA --> [&(20)F(0.1)A][^(20)F(0.1)A]\n")
    with pytest.raises(BudgetError, match=r"plant.l: step 6 of 12: [\d,]+ modules, budget 500 modules"):
        grow_lsystem(path, module_budget=500)
    with pytest.raises(BudgetError, match=r"step 12 of 12: [\d,]+ links, budget 1,000: lower"):
        grow_lsystem(path, link_budget=1000)
    path.write_text("derivation length: 3\nAxiom: F(1)A\nhomomorphism\nmaximum depth: 90\nA --> AA\n")
    with pytest.raises(BudgetError, match=r"step 3 of 3: its homomorphism has [\d,]+ modules"):
        grow_lsystem(path, module_budget=10_000)

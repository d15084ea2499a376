"""L-systems: plants grown by rewriting strings of modules, and drawn by a turtle.

    text of a grammar            read_source     source_text.py; comments off, other kinds of file refused
      | read_system, read_lpy                    macros.py, statements.py, cpfg.lark, compile_rule.py
    System  axiom and rules                      system.py; expressions are closures, never evaluated as Python
      | derive                                   context.py finds the neighbours of a module
    Word    symbols and parameters               derive.py
      | interpret, draw                          interpret.py the homomorphism, turtle.py, polygon.py
    Sketch  stems of nodes, leaves on nodes      sketch.py
      | tidy                                     short and straight links merged, in metres
      | assemble                                 wood.py gives radii
    Plant

The notation is that of cpfg and of Prusinkiewicz and Lindenmayer, "The Algorithmic Beauty of Plants" (1990);
docs/lsystems.md says what of it is read and what each module does.
"""

from windswept.plants.lsystem.grow_lsystem import grammar_names, grow_lsystem

__all__ = ["grammar_names", "grow_lsystem"]

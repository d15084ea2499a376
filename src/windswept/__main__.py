"""``python -m windswept``."""

from windswept.cli import main

main()

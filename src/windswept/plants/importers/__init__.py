"""Foreign presets: each reader maps a file to our species form and reports what became of every value.

path --ending, then content--> one reader --SpeciesDraft--> (Species, ImportReport)

Nothing in a foreign file is ever executed: Python literals are read with `ast`, XML with defusedxml.
"""

from windswept.plants.importers.import_species import ENDINGS, import_species
from windswept.plants.importers.report import ImportReport

__all__ = ["ENDINGS", "ImportReport", "import_species"]

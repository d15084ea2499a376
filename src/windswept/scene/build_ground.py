"""From the ground and nutrient tables of a scene file to the terrain and what it holds for plants."""

from __future__ import annotations

from pathlib import Path

from windswept.errors import InputError
from windswept.forms.read_image import GreyImage, read_grey
from windswept.scene.form import GroundForm
from windswept.scene.spread.nutrients import Nutrient, constant_nutrient, image_nutrient, noise_nutrient
from windswept.scene.spread.spread_form import NutrientForm
from windswept.scene.streams import named_stream
from windswept.scene.terrain import Terrain, flat_terrain, hilly_terrain, image_terrain


def build_terrain(source: str, form: GroundForm, seed: int) -> Terrain:
    """The ground of a scene.

    Args:
        source: the scene file, for error messages and for the image's path.
        form: what it says.
        seed: of the scene.

    Raises:
        InputError: an image that is missing, superfluous, not square or of the wrong kind.
    """
    image = _find_image(source, "ground", form.kind, form.image)
    if image is not None:
        low, high = form.heights_m
        return image_terrain(form.size_m, image.grey, image.step, low, high)
    if form.kind == "flat":
        return flat_terrain(form.size_m)
    return hilly_terrain(form.size_m, form.relief_m, form.hill_length_m, named_stream(seed, "ground"))


def build_nutrients(source: str, forms: list[NutrientForm], size: float, seed: int) -> list[Nutrient]:
    """The nutrients of a scene, in the order of the file.

    Args:
        source: the scene file, for error messages and for images' paths.
        forms: what it says.
        size: edge of the ground, m.
        seed: of the scene.

    Raises:
        InputError: a name given twice, or an image as in `build_terrain`.
    """
    nutrients: list[Nutrient] = []
    for number, form in enumerate(forms):
        place = f"nutrient[{number}]"
        if form.name in [nutrient.name for nutrient in nutrients]:
            raise InputError(source, f"{place}.name", form.name, "a name that no other nutrient has")
        image = _find_image(source, place, form.kind, form.image)
        if image is not None:
            nutrients.append(image_nutrient(form.name, size, form.poor, form.rich, image.grey))
        elif form.kind == "constant":
            nutrients.append(constant_nutrient(form.name, size, form.rich))
        else:
            rng = named_stream(seed, f"nutrient {form.name}")
            nutrients.append(noise_nutrient(form.name, size, form.poor, form.rich, form.patch_m, rng))
    return nutrients


def _find_image(source: str, table: str, kind: str, image: str | None) -> GreyImage | None:
    """The image that a table names; None where it names none and is of no kind that needs one."""
    if image is None:
        if kind == "image":
            raise InputError(source, f"{table}.image", None, "this key to be given: path of a grey image")
        return None
    if kind != "image":
        raise InputError(source, f"{table}.kind", kind, '"image", as an image is given')
    path = Path(source).parent / image
    if not path.is_file():
        expected = "an image, not a folder" if path.is_dir() else f"an image that exists (looked for {path})"
        raise InputError(source, f"{table}.image", image, expected)
    found = read_grey(path)
    rows, columns = found.grey.shape
    if rows != columns:
        expected = f"a square image, as the ground is square: this one has {columns} x {rows} pixels"
        raise InputError(source, f"{table}.image", image, expected)
    return found

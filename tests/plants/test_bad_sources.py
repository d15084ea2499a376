"""Broken files of every family: one line that names the file, and nothing else; no file is ever run."""

import io

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st
from scipy.io import savemat

from windswept.errors import WindsweptError
from windswept.plants.sources import ENDINGS, grow_source

from .importers.preset_files import ARBARO, EZ_TREE, HELIOS, SAPLING, TREE_GEN

BOMB = (
    '<?xml version="1.0"?><!DOCTYPE lolz [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;&a;&a;">'
    '<!ENTITY c "&b;&b;&b;&b;&b;&b;">]><arbaro><species name="&c;"/></arbaro>'
)
OUTSIDE = '<!DOCTYPE a [<!ENTITY x SYSTEM "file:///etc/passwd">]><arbaro><species name="&x;"/></arbaro>'
ROW = "0.1,1,0,0,0,0,0,1,0"


def cells(**changes: str) -> str:
    """A scan of one cylinder with some cells replaced."""
    names = ("radius", "length", "sx", "sy", "sz", "ax", "ay", "az", "parent")
    row = dict(zip(names, ROW.split(","), strict=True)) | changes
    return ",".join(row.values()) + "\n"


def param(name: str, value: str) -> str:
    return f"<arbaro><species name='a'><param name='{name}' value='{value}'/></species></arbaro>"


def matlab(**content: object) -> bytes:
    stream = io.BytesIO()
    savemat(stream, content)
    return stream.getvalue()


BAD: dict[str, tuple[str, str | bytes, str]] = {
    "empty xml": ("a.xml", "", "line 1: expected well-formed XML"),
    "truncated xml": ("a.xml", ARBARO[:500], "well-formed XML"),
    "mismatched tags": ("a.xml", "<arbaro><species></arbaro></species>", "well-formed XML"),
    "xml bomb": ("a.xml", BOMB, "XML without entities"),
    "outside entity": ("a.xml", OUTSIDE, "XML without entities"),
    "other xml": ("a.xml", "<html><body/></html>", "an <arbaro> or <helios> file"),
    "no species": ("a.xml", "<arbaro/>", "with a <species> in it"),
    "no params": ("a.xml", "<arbaro><species name='x'/></arbaro>", "with parameters of a tree"),
    "only unknown params": ("a.xml", param("Colour", "3"), "with parameters of a tree"),
    "word for a number": ("a.xml", param("Scale", "tall"), "Scale = 'tall': expected a finite number"),
    "not a number": ("a.xml", param("Scale", "nan"), "Scale = 'nan': expected a finite number"),
    "infinite": ("a.xml", param("0Length", "1e999"), "0Length = '1e999': expected a finite number"),
    "absurd count": ("a.xml", param("0CurveRes", "-inf"), "expected a finite number"),
    "null bytes": ("a.xml", b"<arbaro>\x00</arbaro>", "well-formed XML"),
    "wrong encoding": (
        "a.xml",
        b"<?xml version='1.0' encoding='utf-8'?><arbaro>\xff</arbaro>",
        "well-formed",
    ),
    "unknown encoding": ("a.xml", "<?xml version='1.0' encoding='klingon'?><arbaro/>", "expected"),
    "deep xml": ("a.xml", "<a>" * 50_000, "expected"),
    "xml too large": ("a.xml", " " * (5 << 20), "an XML file of at most"),
    "binary as xml": ("a.xml", bytes(range(256)), "well-formed XML"),
    "helios without trees": ("a.xml", "<helios><Canopy/></helios>", "a <WeberPennTree> element"),
    "helios words": ("a.xml", HELIOS.replace("3.5", "big"), "Scale = 'big': expected a finite number"),
    "helios five": ("a.xml", HELIOS.replace("1 12 8 0", "1 2 3 4 5 6"), "a number for each of 1 to 4 levels"),
    "empty py": ("a.py", "", "a dictionary of parameters; the file is empty"),
    "code": ("a.py", "import os\nparams = {'g_scale': 3}", "line 1: expected one dictionary"),
    "a call": ("a.py", "params = {'g_scale': max(1, 2)}", "plain values, not code"),
    "a comprehension": ("a.py", "params = {k: 1 for k in 'ab'}", "line 1: expected one dictionary"),
    "syntax": ("a.py", TREE_GEN[:300], "a dictionary of parameters"),
    "list": ("a.py", "[1, 2, 3]", "one dictionary of parameters"),
    "unknown keys": ("a.py", "{'colour': 3}", "keys of a tree-gen or a Sapling preset"),
    "set value": ("a.py", "{'curveRes': {1, 2}}", "curveRes = {1, 2}: expected a finite number"),
    "none value": ("a.py", "{'curveRes': None}", "curveRes: expected a finite number"),
    "bool value": ("a.py", "{'curveRes': True}", "curveRes = True: expected a finite number"),
    "nested lists": ("a.py", "{'curveRes': [[1], 2, 3, 4]}", "curveRes[0] = [1]: expected a finite number"),
    "too many levels": ("a.py", "{'curveRes': [1, 2, 3, 4, 5, 6]}", "a number for each of 1 to 4 levels"),
    "empty list": ("a.py", "{'curveRes': []}", "a number for each of 1 to 4 levels"),
    "half a shape": ("a.py", SAPLING.replace("'7'", "'2.5'", 1), "shape = '2.5': expected a whole number"),
    "shape of words": (
        "a.py",
        SAPLING.replace("'7'", "'round'", 1),
        "shape = 'round': expected a finite number",
    ),
    "huge integer": ("a.py", "{'curveRes': 1" + "0" * 400 + "}", "expected a finite number"),
    "endless integer": ("a.py", "{'curveRes': 1" + "0" * 9000 + "}", "a.py"),
    "deep brackets": ("a.py", "{'curveRes': " + "(" * 5000 + "1", "a.py"),
    "deep minus": ("a.py", "{'curveRes': " + "-" * 100_000 + "1}", "a.py"),
    "unhashable key": ("a.py", "{[1]: 2}", "plain values, not code"),
    "latin py": ("a.py", "{'curveRes': 'é'}".encode("latin-1"), "expected UTF-8 text"),
    "empty json": ("a.json", "", "line 1: expected valid JSON"),
    "truncated json": ("a.json", EZ_TREE[:200], "expected valid JSON"),
    "json list": ("a.json", "[1, 2]", "a JSON object"),
    "json without branch": ("a.json", '{"leaves": {}}', "branch: expected this key"),
    "branch is a number": ("a.json", '{"branch": 3}', "branch = 3: expected a table"),
    "length is a list": ("a.json", '{"branch": {"length": [1, 2]}}', "length = [1, 2]: expected a table"),
    "length is a word": ("a.json", '{"branch": {"length": {"0": "x"}}}', "branch.length.0 = 'x'"),
    "json infinity": ("a.json", '{"branch": {"length": {"0": Infinity}}}', "expected a finite number"),
    "json null": ("a.json", '{"branch": {"levels": null}}', "branch.levels: expected a finite number"),
    "deep json": ("a.json", "[" * 100_000, "a.json"),
    "long json number": ("a.json", '{"branch": ' + "1" * 9000 + "}", "a.json"),
    "list line": ("a.txt", "Scale = 3\nhello there\n", "line 2: expected a line of the form Name = Value"),
    "empty list file": ("a.arb", "", "with parameters of a tree"),
    "list word": ("a.txt", "Scale = big\n", "Scale = 'big': expected a finite number"),
    "empty scan": ("a.csv", "", "at least one cylinder"),
    "only a heading": ("a.csv", "radius,length\n", "at least one cylinder"),
    "short row": ("a.csv", "0.1,1,0,0\n", "line 1: expected at least 9 columns"),
    "word in a cell": (
        "a.csv",
        cells() + cells(length="long"),
        "line 2, column 2 = 'long': expected a number",
    ),
    "nan in a cell": ("a.csv", cells(sx="nan"), "cylinder 1, start x = nan: expected a finite number"),
    "no radius": ("a.csv", cells(radius="0"), "cylinder 1, radius = 0.0: expected a radius above 0"),
    "negative radius": ("a.csv", cells(radius="-1"), "expected a radius above 0"),
    "radius in millimetres": ("a.csv", cells(radius="180"), "expected a radius above 0 in m"),
    "negative length": ("a.csv", cells(length="-1"), "expected a length above 0"),
    "no axis": ("a.csv", cells(az="0"), "expected an axis that points somewhere"),
    "huge place": ("a.csv", cells(sx="1e300"), "expected a number that a tree can have"),
    "far apart": ("a.csv", cells() + cells(sz="400", parent="1"), "a tree of at most 150 m"),
    "half a parent": ("a.csv", cells(parent="0.5"), "parent = 0.5: expected the row of another cylinder"),
    "parent outside": ("a.csv", cells(parent="7"), "parent = 7.0: expected the row of another cylinder"),
    "negative parent": ("a.csv", cells(parent="-1"), "parent = -1.0: expected the row of another cylinder"),
    "own parent": ("a.csv", cells(parent="1"), "parent = 1.0: expected the row of another cylinder"),
    "cycle": ("a.csv", cells() + cells(parent="3") + cells(parent="2"), "expected parents without a cycle"),
    "only a cycle": ("a.csv", cells(parent="2") + cells(parent="1"), "expected parents without a cycle"),
    "binary csv": ("a.csv", bytes(range(256)), "expected UTF-8 text"),
    "empty mat": ("a.mat", b"", "a MATLAB file"),
    "text as mat": ("a.mat", "hello" * 100, "a MATLAB file"),
    "truncated mat": ("a.mat", matlab(CylData=np.ones((50, 9)))[:900], "a MATLAB file"),
    "mat of another kind": ("a.mat", matlab(x=np.ones(3)), "a structure with radius, length"),
    "hdf5 mat": ("a.mat", b"\x89HDF\r\n\x1a\n" + bytes(600), "save it with -v7"),
    "mat of words": ("a.mat", matlab(cylinder={"radius": "abc", "length": "abc"}), "a structure with radius"),
    "empty npz": ("a.npz", b"", "an .npz file that windswept saved a plant to, and whole"),
    "text as npz": ("a.npz", "plant", "an .npz file that windswept saved a plant to, and whole"),
    "unknown ending": ("a.zip", "x", "a file that ends in one of"),
    "no ending": ("folder/a", "x", "a file that ends in one of"),
    "empty toml": ("a.toml", "", "name: expected this key to be given"),
    "empty grammar": ("a.l", "", "a.l"),
    "lex file": ("a.l", "%{\n#include <stdio.h>\n%}\n%%\n[a-z]+ { return 1; }\n%%\n", "a.l"),
    "lpfg file": (
        "a.l",
        "#include <lpfgall.h>\nmodule A(float);\nderivation length: 3;\nAxiom: A(1);\n",
        "a.l",
    ),
    "python in lpy": ("a.lpy", "import os\nos.system('true')\nAxiom: F\n", "a.lpy"),
}


def assert_one_line(path, said: str = "") -> None:
    with pytest.raises(WindsweptError) as caught:
        grow_source(str(path))
    text = str(caught.value)
    assert said in text
    assert str(path) in text
    assert "\n" not in text
    assert len(text) < 600 + len(str(path))


@pytest.mark.parametrize("name", BAD)
def test_broken_file(tmp_path, name) -> None:
    file, content, said = BAD[name]
    path = tmp_path / file
    path.parent.mkdir(exist_ok=True)
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    assert_one_line(path, said)


@pytest.mark.parametrize("ending", ENDINGS)
def test_missing_files_and_directories(tmp_path, ending) -> None:
    assert_one_line(tmp_path / f"none{ending}", "expected")
    (tmp_path / f"folder{ending}").mkdir()
    assert_one_line(tmp_path / f"folder{ending}", "expected")


def test_names_and_seeds() -> None:
    for source, said in (
        ("hazle", "did you mean hazel?"),
        ("", "source: expected"),
        ("a\nb", "a b: expected"),
    ):
        with pytest.raises(WindsweptError) as caught:
            grow_source(source)
        assert said in str(caught.value)
    with pytest.raises(WindsweptError, match="a whole number from 0 up"):
        grow_source("hazel", seed=-1)


SAMPLES = {".xml": ARBARO, ".py": SAPLING, ".json": EZ_TREE, ".csv": cells() + cells(sz="1", parent="1")}


@pytest.mark.parametrize("ending", SAMPLES)
def test_fuzzed_files_grow_or_are_told(tmp_path_factory, ending) -> None:
    path = tmp_path_factory.mktemp("fuzz") / f"a{ending}"
    sample, lines = SAMPLES[ending].encode(), []

    @settings(max_examples=60, deadline=None, derandomize=True, suppress_health_check=list(HealthCheck))
    @given(
        start=st.integers(0, len(sample)),
        length=st.integers(0, 40),
        put=st.one_of(
            st.binary(max_size=12), st.sampled_from([b"-1", b"1e30", b"nan", b"999999", b"{", b'"'])
        ),
    )
    @example(start=0, length=0, put=b"")
    def check(start: int, length: int, put: bytes) -> None:
        path.write_bytes(sample[:start] + put + sample[start + length :])
        try:
            plant = grow_source(path)
        except WindsweptError as error:
            lines.append(str(error))
        else:
            assert np.isfinite(plant.link_tip).all()

    check()
    assert all("\n" not in line for line in lines)

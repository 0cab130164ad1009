"""Somebody who checks a code of their own reads the values in their own language: each reader runs here, and all say the same.

A reader that passes over damage would make a wrong reference out of a right one: each kind of damage must stop it with one line.
"""

import hashlib
import json
import shutil
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest

from rkverify.certify.reference.case import canonical
from rkverify.certify.reference.catalogue import FAMILIES as ALL
from rkverify.certify.reference.catalogue import family
from rkverify.certify.reference.writing import COLUMNS, document, rows

ROOT = Path(__file__).resolve().parents[2]
READERS, COMMITTED = ROOT / "readers", ROOT / "reports" / "results" / "reference_values"
FAMILIES = ("kernels", "rates")
COMPILER, OCTAVE = (next(filter(None, map(shutil.which, names)), None) for names in (("cc", "gcc"), ("octave-cli", "octave")))  # fmt: skip
LANGUAGES = [
    "python",
    pytest.param("c", marks=pytest.mark.skipif(COMPILER is None, reason="there is no C compiler: install gcc")),
    pytest.param("octave", marks=pytest.mark.skipif(OCTAVE is None, reason="Octave is not installed: apt-get install octave")),
]  # fmt: skip


@pytest.fixture(scope="session")
def command(tmp_path_factory):
    """command(language) -> the words that run its reader."""
    made = {}

    def words(language):
        if language == "c" and "c" not in made:
            made["c"] = str(tmp_path_factory.mktemp("c") / "read_reference")
            source = str(READERS / "c" / "read_reference.c")
            strict = ["-std=c99", "-Wall", "-Wextra", "-Werror"]
            subprocess.run([COMPILER, *strict, "-o", made["c"], source, "-lm"], check=True)
        return {
            "python": [sys.executable, "-I", str(READERS / "python" / "read_reference.py")],
            "c": [made.get("c", "")],
            "octave": [str(OCTAVE), "--no-history", str(READERS / "octave" / "read_reference.m")],
        }[language]

    return words


@pytest.fixture
def read(command, tmp_path):
    """read(language, text, ending) -> the finished process of a reader on a file with this text."""

    def run(language, text, ending="csv"):
        file = tmp_path / f"values.{ending}"
        file.write_bytes(text if isinstance(text, bytes) else text.encode())
        return subprocess.run([*command(language), str(file)], capture_output=True, text=True, check=False)

    return run


def table(name):
    """The CSV of a family as the study writes it."""
    lines = [",".join(COLUMNS), *(",".join(map(str, row.values())) for row in rows(family(name)))]
    return "\n".join(lines) + "\n"


def expected(name):
    return [(row["case"], row["quantity"], float(Fraction(str(row["value"])))) for row in rows(family(name))]


def parsed(done):
    assert (done.returncode, done.stderr) == (0, "")
    lines = [line.split(",") for line in done.stdout.splitlines()]
    return [(case, quantity, float(value)) for case, quantity, value in lines]


def complaint(done):
    """The one line by which damage is answered, with a status that is not zero."""
    assert done.returncode != 0
    assert done.stderr.count("\n") == 1, done.stderr
    assert done.stderr.startswith("read_reference: ")
    assert len(done.stderr) < 300
    return done.stderr


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("name", FAMILIES)
def test_every_reader_gives_the_nearest_double_of_every_value(language, name, read):
    """Compared with the exact decimal rounded once: all readers agree to the last bit."""
    assert parsed(read(language, table(name))) == expected(name)


@pytest.mark.parametrize("name", FAMILIES)
def test_json_gives_the_same_as_csv(name, read):
    assert parsed(read("python", document(name, family(name)), "json")) == expected(name)


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_reader_reads_every_committed_file(language, command):
    """What a user finds in the checkout, all of it, in every language."""
    found = {}
    for file in sorted(COMMITTED.glob("*.csv")):
        header, *lines = file.read_text(encoding="ascii").splitlines()
        if header != ",".join(COLUMNS):
            continue
        done = subprocess.run([*command(language), str(file)], capture_output=True, text=True, check=False)
        rows = [line.split(",") for line in lines]
        assert parsed(done) == [(row[1], row[2], float(Fraction(row[3]))) for row in rows]
        found[file.stem] = len(rows)
    assert set(found) == set(ALL)
    assert min(found.values()) > 50


def _value(text):
    def damage(table):
        lines = table.splitlines()
        cells = lines[3].split(",")
        cells[3] = text
        return "\n".join([*lines[:3], ",".join(cells), *lines[4:]]) + "\n"

    return damage


DAMAGES = {
    "rows missing at the end": (lambda table: "".join(table.splitlines(keepends=True)[:-2]), ""),
    "cut within a row": (lambda table: table[: len(table) // 2], "row"),
    "cut within the last hash": (lambda table: table[:-9], "row"),
    "a row missing in the middle": (lambda table: "".join(line for k, line in enumerate(table.splitlines(keepends=True)) if k != 3), "row"),
    "not a number": (_value("nan"), "no finite number"),
    "infinite": (_value("-inf"), "no finite number"),
    "a huge exponent": (_value("1.0e999999999"), "no finite number"),
    "an exponent beyond doubles": (_value("1.0e309"), "no finite number"),
    "letters after the number": (_value("1.5x"), "no finite number"),
    "no number": (_value(""), "no finite number"),
    "a cell too many": (_value("1,5"), "row"),
    "a digit changed": (_value("1.5"), "wrong checksum"),
    "a wrong hash": (lambda table: table[:-20] + ("0" if table[-20] != "0" else "1") + table[-19:], "wrong checksum"),
    "a wrong checksum": (lambda table: table[:-3] + ("0" if table[-3] != "0" else "1") + table[-2:], "wrong checksum"),
    "a checksum that is none": (lambda table: table[:-3] + "xy\n", "wrong checksum"),
    "two rows exchanged": (lambda table: "".join(table.splitlines(keepends=True)[k] for k in (0, 2, 1)), "row"),
    "bytes that are no text": (lambda table: table.encode()[:200] + b"\xff\x00" + table.encode()[200:], ""),
    "a line without end": (lambda table: table + "9" * 10_000, ""),
    "nothing": (lambda table: "", ""),
    "only the header": (lambda table: table.splitlines()[0] + "\n", ""),
}  # fmt: skip


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("damage", DAMAGES)
def test_damage_stops_every_reader(language, damage, read):
    change, says = DAMAGES[damage]
    assert says in complaint(read(language, change(table("rates"))))


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_file_that_is_not_there_is_one_line(language, command, tmp_path):
    done = subprocess.run([*command(language), str(tmp_path / "none.csv")], capture_output=True, text=True, check=False)
    complaint(done)
    complaint(subprocess.run(command(language), capture_output=True, text=True, check=False))


def _json(change, anew=()):
    """The JSON of a family with its first case changed, the hashes of some parts made anew."""
    data = json.loads(document("rates", family("rates")))
    case = data["cases"][0]
    change(case)
    for part in anew:
        case[f"{part}_sha256"] = hashlib.sha256(canonical(case[part]).encode()).hexdigest()
    return json.dumps(data)


def _digit(case):
    name = next(iter(case["values"]))
    text, digits = case["values"][name]
    case["values"][name] = [text.replace("1", "2", 1), digits]


def _put(text):
    def change(case):
        case["values"][next(iter(case["values"]))] = [text, 30]

    return change


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (_json(_digit), "wrong hash of the values"),
        (_json(lambda case: case["inputs"].update(order=2)), "wrong hash of the inputs"),
        (_json(lambda case: case.update(inputs_sha256="0" * 64)), "wrong hash of the inputs"),
        (_json(_put("nan"), ["values"]), "no finite number"),
        (_json(_put("1.0e999999999"), ["values"]), "no finite number"),
        (_json(_put("1.0e999"), ["values"]), "no finite number"),
        (_json(lambda case: None).replace("values 1", "values 9", 1), "unknown format"),
        (_json(lambda case: None)[:500], ""),
        ("[" * 100_000, ""),
        ("[]", ""),
        (b"\xff\xfe", ""),
    ],
    ids=range(11),
)  # fmt: skip
def test_damaged_json_is_refused(text, says, read):
    assert says in complaint(read("python", text, "json"))
    assert parsed(read("python", _json(lambda case: None), "json")) == expected("rates")

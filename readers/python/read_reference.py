"""Print case, quantity and value of reference values: python read_reference.py FILE.json (hashes are checked) or FILE.csv."""

import hashlib
import json
import math
import re
import sys
import zlib
from pathlib import Path

NUMBER = re.compile(r"-?\d(\.\d+)?(e-?\d{1,3})?")


def hashed(data):
    """SHA-256 of data as JSON with sorted keys and without spaces."""
    return hashlib.sha256(json.dumps(data, sort_keys=True, separators=(",", ":")).encode()).hexdigest()


def from_json(text):
    """The values of a JSON file, whose hashes must be right."""
    data = json.loads(text)
    if data["format"] != "rkverify reference values 1":
        raise ValueError(f"unknown format {data['format']!r}")
    for case in data["cases"]:
        for part in ("inputs", "values"):
            if hashed(case[part]) != case[part + "_sha256"]:
                raise ValueError(f"wrong hash of the {part} of case {case['case']!r}")
        yield from ((case["case"], name, value) for name, (value, digits) in case["values"].items())


def from_csv(text):
    """The values of a CSV file, whose rows must be all there."""
    lines = text.splitlines()[1:]
    for k, line in enumerate(lines, 1):
        row = line.split(",")
        if len(row) != 12 or (len(row[10]), len(row[11])) != (64, 8) or row[0] != f"{k}/{len(lines)}":
            raise ValueError(f"row {k} is damaged, or rows are missing after it")
        yield row[1], row[2], row[3]
        if f"{zlib.adler32(line[:-9].encode()):08x}" != row[11]:
            raise ValueError(f"row {k} has the wrong checksum")
    if not lines:
        raise ValueError("no rows")


def read(path):
    """List of (case, quantity, decimal text)."""
    text = Path(path).read_text(encoding="utf-8")
    found = []
    for case, name, value in (from_json if path.endswith(".json") else from_csv)(text):
        if not NUMBER.fullmatch(value) or not math.isfinite(float(value)):
            raise ValueError(f"{name} of case {case!r} is no finite number: {value[:40]}")
        found.append((case, name, value))
    return found


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("read_reference: name one file, FILE.json or FILE.csv")
    try:
        for case, name, value in read(sys.argv[1]):
            print(f"{case},{name},{float(value):.17g}")
    except (OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError) as error:
        sys.exit(f"read_reference: {sys.argv[1]}: {error}")

"""`rkverify reference` prints what the study writes, for whoever has the package and no checkout."""

import json

from rkverify.certify.reference.catalogue import family
from rkverify.certify.reference.writing import COLUMNS, document


def test_a_family_as_csv(rkverify):
    done = rkverify("reference", "kernels")
    assert (done.status, done.err, done.header) == (0, "", ",".join(COLUMNS))
    assert len(done.rows) == sum(len(case.values) for case in family("kernels"))
    at_node = next(row for row in done.rows if (row["case"], row["quantity"]) == ("kernel cubic", "phi[0]"))
    assert at_node["value"] == "6." + "6" * 28 + "7e-1"


def test_a_family_as_json(rkverify, tmp_path):
    """With the inputs, and the same text as the study's document."""
    file = tmp_path / "kernels.json"
    assert rkverify("reference", "kernels", "--json", "--out", file).out == ""
    assert file.read_text() == document("kernels", family("kernels"))
    assert json.loads(file.read_text())["cases"][0]["inputs"]["kernel"]


def test_an_unknown_family_is_one_line(rkverify):
    assert "kernels" in rkverify("reference", "no-such").complaint()

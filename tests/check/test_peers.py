"""Other packages' numbers are read with where they come from; what they are is the study `peers`' to say."""

import pytest

from rkverify.check import peer_tables as tables
from rkverify.check.peers import COUNTERPARTS, counterpart
from rkverify.check.shape import check_shape
from rkverify.errors import BadInput


def test_every_table_has_a_counterpart_and_every_counterpart_a_table():
    """But for the one in which PySPH mixes two derivatives."""
    found = {table.name: counterpart(table) for table in tables.peer_tables()}
    assert [name for name, one in found.items() if one is None] == ["pysph_plane_crksph_default"]
    assert {one.says for one in found.values() if one is not None} == {one.says for one in COUNTERPARTS}


def test_numbers_made_from_other_inputs_are_refused(monkeypatch, tmp_path):
    """Nodes that changed under their values would show as a difference of the packages."""
    for file in tables.folder().glob("*.csv"):
        (tmp_path / file.name).write_bytes(file.read_bytes())
    monkeypatch.setattr(tables, "folder", lambda: tmp_path)
    before = tables.fingerprint()
    assert tables.peer_tables()
    nodes = tmp_path / "nodes_plane.csv"
    nodes.write_text(nodes.read_text(encoding="utf-8").replace("0.", "0.0", 1), encoding="utf-8")
    assert tables.fingerprint() != before
    with pytest.raises(BadInput, match="make peers"):
        tables.peer_tables()


def test_a_package_that_has_full_derivatives_passes():
    table = next(t for t in tables.peer_tables() if t.name == "pysph_plane_crksph")
    assert check_shape(table.claim, table.theirs).passed


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("pysph_own_crksph", "mean of the node's and the point's and kernels divided by a^d"),
        ("pycompadre_own", "supports owned by the point (target) and diffuse derivatives"),
        ("pycompadre_plane_power", "the weights (1 - z)^2"),
        ("pysph_plane_crksph_default", "Only 23 of 611 pairs differ"),
    ],
)
def test_what_packages_do_is_named(name, words):
    """Somebody else wrote these numbers: what is tried against our own formulas elsewhere is held against the world here."""
    table = next(t for t in tables.peer_tables() if t.name == name)
    assert words in check_shape(table.claim, table.theirs).verdict

"""rkverify export: what the two forms write, and what is refused in one line."""

import json


def test_latex_is_written_and_long_tables_are_named(rkverify, tmp_path) -> None:
    done = rkverify("export", "--latex", "gradients", "--out", tmp_path / "a paper", "--rows", "10")
    assert (done.status, done.err) == (0, "")
    assert "uses all of them" in done.out
    assert "left out for more than 10 rows: gradients/widths.csv" in done.out
    assert {p.name for p in (tmp_path / "a paper").iterdir()} == {
        "rkverify-numbers.tex",
        "rkverify-example.tex",
        "rkverify-gradients-sums.tex",
    }


def test_metadata_are_written_where_asked(rkverify, tmp_path) -> None:
    done = rkverify("export", "--ro-crate", "--out", tmp_path)
    assert (done.status, done.err) == (0, "")
    data = json.loads((tmp_path / "ro-crate-metadata.json").read_text(encoding="utf-8"))
    assert data["@graph"][0]["@id"] == "ro-crate-metadata.json"


def test_what_is_refused(rkverify, tmp_path) -> None:
    assert "--latex --ro-crate" in rkverify("export").complaint()
    assert "say where with --out DIR" in rkverify("export", "--latex").complaint()
    assert "leave gradients out" in rkverify("export", "--ro-crate", "gradients").complaint()
    assert "ask for at least one" in rkverify("export", "--latex", "--out", tmp_path, "--rows", "0").complaint()
    assert list(tmp_path.iterdir()) == []

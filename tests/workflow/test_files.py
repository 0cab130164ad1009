"""A reader of a file that we write sees the old text or the new one, whatever happens while it is written.

Results that are committed, and records by which a run decides what is up to date, must never be half of something.
"""

import errno
import os
import threading
from pathlib import Path

import pytest

from rkverify.errors import BadInput
from rkverify.workflow.files import read, sweep, write_atomically


def parts(folder):
    return list(folder.rglob(".part-*"))


def test_a_new_file_has_the_text_and_can_be_read_by_all(tmp_path):
    path = tmp_path / "new" / "folder" / "file"
    write_atomically(path, "Ψ\n")
    assert path.read_bytes() == "Ψ\n".encode()
    assert path.stat().st_mode & 0o777 == 0o644
    assert parts(tmp_path) == []


def disk_full(handle):
    raise OSError(errno.ENOSPC, "No space left on device")


def interrupted(handle):
    raise KeyboardInterrupt


@pytest.mark.parametrize(("accident", "raised"), [(disk_full, BadInput), (interrupted, KeyboardInterrupt)])
def test_an_accident_while_writing_leaves_the_old_file(accident, raised, tmp_path, monkeypatch):
    path = tmp_path / "file"
    write_atomically(path, "old\n")
    monkeypatch.setattr(os, "fsync", accident)
    with pytest.raises(raised):
        write_atomically(path, "new\n")
    assert path.read_text(encoding="utf-8") == "old\n"
    assert parts(tmp_path) == []


def test_a_text_that_cannot_be_encoded_leaves_the_old_file(tmp_path):
    path = tmp_path / "file"
    write_atomically(path, "old\n")
    with pytest.raises(UnicodeEncodeError):
        write_atomically(path, "\ud800")
    assert path.read_text(encoding="utf-8") == "old\n"
    assert parts(tmp_path) == []


@pytest.mark.parametrize("place", ["plain file", "folder"])
def test_a_place_that_cannot_be_written_is_named(place, tmp_path):
    if place == "folder":
        path = tmp_path / "file"
        (path / "inside").mkdir(parents=True)
    else:
        (tmp_path / "plain").write_text("", encoding="utf-8")
        path = tmp_path / "plain" / "file"
    with pytest.raises(BadInput, match="cannot write") as caught:
        write_atomically(path, "text")
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)
    assert parts(tmp_path) == []


def test_a_folder_without_permission_is_named(fresh):
    """The same by permission bits, as somebody whom they bind."""
    (fresh.root / "locked").mkdir(mode=0o555)
    script = "from pathlib import Path\nfrom rkverify.workflow.files import write_atomically\n"
    done = fresh.python("-c", f"{script}write_atomically(Path('locked') / 'file', 'text')", anybody=True)
    assert "BadInput: cannot write locked/file: Permission denied" in done.stderr
    assert list((fresh.root / "locked").iterdir()) == []


def test_a_reader_never_sees_a_part(tmp_path):
    path = tmp_path / "file"
    texts = {letter * 200_000 for letter in "ab"}
    write_atomically(path, min(texts))
    done = threading.Event()
    seen = []

    def look():
        while not done.is_set():
            seen.append(read(path) in texts)

    reader = threading.Thread(target=look)
    reader.start()
    for _ in range(20):
        for text in texts:
            write_atomically(path, text)
    done.set()
    reader.join()
    assert seen
    assert all(seen)


def test_sweep_takes_parts_and_nothing_else(tmp_path):
    (tmp_path / "a").mkdir()
    for name in (".part-x", "a/.part-y", "kept", "a/part-kept"):
        (tmp_path / name).write_text("", encoding="utf-8")
    sweep(tmp_path)
    assert sorted(p.relative_to(tmp_path).as_posix() for p in tmp_path.rglob("*")) == ["a", "a/part-kept", "kept"]


@pytest.mark.parametrize(("owner", "step"), [(os, "fsync"), (Path, "chmod"), (Path, "replace")])
def test_a_run_that_starts_does_not_take_the_parts_of_one_that_is_writing(owner, step, tmp_path, monkeypatch):
    """Two terminals: what `sweep` is for are the parts of killed processes, and a living one still needs its own."""
    real = getattr(owner, step)

    def meanwhile(*words):
        sweep(tmp_path)
        return real(*words)

    monkeypatch.setattr(owner, step, meanwhile)
    write_atomically(tmp_path / "file", "text")
    assert read(tmp_path / "file") == "text"


@pytest.mark.parametrize("content", [b"\xff\xfe", None])
def test_what_cannot_be_read_is_none(content, tmp_path):
    if content is not None:
        (tmp_path / "file").write_bytes(content)
    assert read(tmp_path / "file") is None

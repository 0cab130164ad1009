"""Writing files so that a reader sees the old one or the new one and never a part."""

import fcntl
import os
import tempfile
from pathlib import Path

from rkverify.errors import BadInput


def write_atomically(path: Path, text: str) -> None:
    """Replace the file at path by one with this text, in one step.

    The new file is written under a name that begins with a dot, which a killed process may leave behind;
    `sweep` removes it. Raises BadInput where the folder cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(prefix=".part-", dir=path.parent)
        try:
            with os.fdopen(handle, "w", encoding="utf-8", newline="\n") as stream:
                fcntl.flock(stream, fcntl.LOCK_EX)  # held until the file has its name: the sign that its writer lives
                stream.write(text)
                stream.flush()
                os.fsync(stream.fileno())
                Path(name).chmod(0o644)
                Path(name).replace(path)
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise
    except OSError as error:
        raise BadInput(f"cannot write {path}: {error.strerror}; make the folder writable or choose another") from None


def sweep(folder: Path) -> None:
    """Remove what killed processes left half-written, and nothing of those that still write."""
    for part in folder.rglob(".part-*"):
        try:
            with part.open("rb") as stream:
                fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
                part.unlink(missing_ok=True)
        except OSError:
            continue


def read(path: Path) -> str | None:
    """The text of a file, or None where there is no readable one."""
    try:
        return path.read_bytes().decode("utf-8")  # with its line ends, which count
    except (OSError, UnicodeDecodeError):
        return None

"""rkverify recheck"""

import sys
import time
from argparse import Namespace
from pathlib import Path

from rkverify.errors import BadInput
from rkverify.paths import checkout
from rkverify.recheck import recheck as verified


def _logs() -> list[Path]:
    """The proof logs of the checkout."""
    folder = checkout().results / "theorems"
    others = ("statements.json", "study.json")
    found = sorted(path for path in folder.glob("*.json") if path.name not in others)
    if not found:
        raise BadInput(f"there is no proof log under {folder}: run `rkverify run theorems`, or name a file")
    return found


def recheck(options: Namespace) -> int:
    """Verify proof logs; 1 if one is damaged or proves less than it claims."""
    start, theorems, wrong = time.perf_counter(), 0, 0
    files = [Path(name) for name in options.files] or _logs()
    for path in files:
        try:
            found = verified(_text(path))
        except BadInput as error:
            print(f"rkverify: {path}: {error}", file=sys.stderr)
            wrong += 1
            continue
        theorems += len(found)
        if not options.quiet:
            print("\n".join(f"{path.stem}: {words}" for _, words in found))
    print(f"{theorems} theorems verified, {wrong} of {len(files)} logs refused, {time.perf_counter() - start:.1f} s")
    return 1 if wrong else 0


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except OSError as error:
        raise BadInput(f"cannot be read: {error.strerror}") from None
    except UnicodeDecodeError:
        raise BadInput("is no text in UTF-8") from None

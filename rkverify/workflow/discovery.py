"""The studies of a checkout, found by their files."""

import importlib
import pkgutil
import sys
from difflib import get_close_matches

from rkverify.errors import BadInput, UnknownName
from rkverify.paths import Checkout
from rkverify.workflow.study import Study

MENTIONED = 5
"""Names like the unknown one that an error mentions: a line is to be read."""


def study_names(place: Checkout) -> list[str]:
    """The names of the studies: every module of studies/ that does not begin with an underscore."""
    return sorted(m.name for m in pkgutil.iter_modules([str(place.studies)]) if not m.name.startswith("_"))


def choose(place: Checkout, names: list[str]) -> list[str]:
    """The named studies, or all of them for no name.

    Raises UnknownName.
    """
    known = study_names(place)
    for name in names:
        if name not in known:
            near = get_close_matches(name, known, MENTIONED, 0.0)
            few = [f"those that `rkverify list` shows, such as {', '.join(near)}"]
            raise UnknownName("study", name, known if len(known) <= MENTIONED else few)
    return sorted(set(names)) or known


def load(place: Checkout, name: str) -> Study:
    """The study of that name.

    Raises BadInput where its file defines no STUDY.
    """
    if str(place.root) not in sys.path:
        sys.path.insert(0, str(place.root))
    try:
        study = getattr(importlib.import_module(f"studies.{name}"), "STUDY", None)
    except Exception as error:
        raise BadInput(f"studies/{name}.py cannot be imported: {type(error).__name__}: {error}") from error
    if not isinstance(study, Study):
        raise BadInput(f"studies/{name}.py defines no STUDY: end it with STUDY = Study(...)")
    return study

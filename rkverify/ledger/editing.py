"""Adding a study to the lists of ledger and pages, as text: whatever else a file says stays as it is written."""

import re
import tomllib

from rkverify.errors import BadInput

LIST = re.compile(r"^studies = \[[^\]]*\]$", re.MULTILINE)


def with_study(text: str, id: str, study: str) -> str:
    r"""The TOML text of a ledger file in which the entry lists the study as well, in the order of the alphabet.

    Raises BadInput where the file does not have the entry with a list that can be found.

    >>> print(with_study('[[entry]]\nid = "E1"\nstudies = ["kernels"]', "E1", "gradients"))
    [[entry]]
    id = "E1"
    studies = ["gradients", "kernels"]
    """
    head, mark, rest = text.partition(f'[[entry]]\nid = "{id}"\n')
    own, more, others = rest.partition("\n[[entry]]\n")
    found = LIST.search(own)
    if not mark or not found:
        raise BadInput(f"entry {id} has no list of studies that can be edited: add {study!r} to it by hand")
    listed = sorted({*tomllib.loads(found[0])["studies"], study})
    line = "studies = [" + ", ".join(f'"{name}"' for name in listed) + "]"
    return head + mark + own[: found.start()] + line + own[found.end() :] + more + others


def shown_on(text: str, study: str) -> str:
    r"""The TOML text of a page of the report on which the study is shown as well, after the others.

    Raises BadInput where the file has no list of studies that can be found.

    >>> print(shown_on('studies = ["kernels"]\nlead = ""', "gradients"))
    studies = ["kernels", "gradients"]
    lead = ""
    """
    found = LIST.search(text)
    if not found:
        raise BadInput(f"the page has no list of studies that can be edited: add {study!r} to it by hand")
    line = found[0]
    if "\n" in line:
        line = f'{line[:-1].rstrip()}\n  "{study}",\n]'
    else:
        line = f'{line[:-1]}, "{study}"]'.replace("[, ", "[")
    return text[: found.start()] + line + text[found.end() :]

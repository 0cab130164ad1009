"""Executing the notebooks into reports/notebooks: `python -m rkverify.report.notebooks [NAME …]`.

Each is run as nbconvert runs it, in a process of its own, and written twice: as a notebook with its outputs and as a page. Run twice
they are the same: cells keep their ids, times are not recorded, figures are the same for the same data.
"""

import asyncio
import json
import os
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from rkverify.errors import BadInput, RkverifyError, UnknownName
from rkverify.paths import Checkout, checkout
from rkverify.report.content import build_foot
from rkverify.report.notebook_pages import index_page, notebook_page
from rkverify.workflow.files import write_atomically

SECONDS = 120
"""A cell that takes longer is stopped."""


@dataclass(frozen=True)
class Source:
    """A notebook as it is stored, without outputs: its name, its title, its place in the order."""

    name: str
    title: str
    lead: str
    order: int
    path: Path


def sources(place: Checkout) -> list[Source]:
    """The notebooks of a checkout, in the order that their metadata say."""
    found = []
    for path in place.root.joinpath("notebooks").glob("*.ipynb"):
        data = json.loads(path.read_text(encoding="utf-8"))
        first = "".join(data["cells"][0]["source"])
        title, _, rest = first.partition("\n")
        lead = rest.strip().partition("\n\n")[0]
        found.append(Source(path.stem, title.removeprefix("# "), lead, data["metadata"]["rkverify"]["order"], path))
    return sorted(found, key=lambda s: (s.order, s.name))


def execute(path: Path) -> Any:
    """The notebook with the outputs of all of its cells.

    Raises BadInput, in one line, where a cell fails or writes to standard error.
    """
    import nbformat
    from nbclient import NotebookClient
    from nbclient.exceptions import CellExecutionError
    from traitlets.config import Config

    done = nbformat.read(path, as_version=4)
    with TemporaryDirectory(prefix="rkverify-") as folder:
        # Sockets in a folder of our own: no port is opened, and nobody else can listen.
        sockets = Config({"KernelManager": {"transport": "ipc", "ip": f"{folder}/kernel"}})
        here = {"metadata": {"path": str(path.parent)}}
        client = NotebookClient(
            done, timeout=SECONDS, kernel_name="python3", record_timing=False, resources=here, config=sockets
        )
        try:
            with ThreadPoolExecutor(1) as apart:  # a loop of its own, whatever loop runs here
                apart.submit(lambda: asyncio.run(client.async_execute())).result()
        except CellExecutionError as error:
            raise BadInput(f"{path.name}: {error.ename}: {' '.join(error.evalue.split())}") from None
    for cell in done.cells:
        for output in cell.get("outputs", []):
            if output.get("name") == "stderr":
                raise BadInput(f"{path.name}: cell {cell.id} warns: {' '.join(output.text.split())[:200]}")
    return done


def text_of(notebook: Any) -> str:
    """The executed notebook as the text of its file."""
    return json.dumps(notebook, indent=1, sort_keys=True, ensure_ascii=False) + "\n"


def build(place: Checkout, names: Sequence[str] = (), processes: int | None = None) -> Path:
    """Execute the named notebooks, or all, and write them with their pages and a list of them; returns the list.

    Raises UnknownName, and BadInput as `execute` does.
    """
    every = sources(place)
    known = [source.name for source in every]
    for name in names:
        if name not in known:
            raise UnknownName("notebook", name, known)
    chosen = [source for source in every if not names or source.name in names]
    with ThreadPoolExecutor(processes or os.cpu_count()) as pool:  # the work is done by the kernels' processes
        done = dict(zip(chosen, pool.map(execute, [source.path for source in chosen]), strict=True))
    foot = build_foot(place, datetime.now(UTC).strftime("%Y-%m-%d %H:%M UTC"))
    folder = place.pages / "notebooks"
    for source, notebook in done.items():
        write_atomically(folder / f"{source.name}.ipynb", text_of(notebook))
        write_atomically(folder / f"{source.name}.html", notebook_page(place, every, source, notebook, foot))
    write_atomically(folder / "index.html", index_page(place, every, foot))
    return folder / "index.html"


def main(names: Sequence[str]) -> int:
    """Build, and say where the list is; 2 with one line if a notebook fails."""
    place = checkout()
    try:
        print(f"open {place.shown(build(place, names))}")
    except RkverifyError as error:
        print(f"rkverify: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

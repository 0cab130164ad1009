"""Running one study: from its parameters to the texts of its artefacts, each with its rule of comparison."""

from dataclasses import asdict, dataclass
from typing import Any

from rkverify.workflow.compare import Comparison, Exact, Record, Visual
from rkverify.workflow.identity import Identity, canonical
from rkverify.workflow.study import Study

STATEMENTS = "statements.json"
DESCRIPTION = "study.json"

VISUAL = Visual(0.05, "points of 1/72 inch: text is laid out by the font library, data are compared in their tables")
WORDS = Record(5e-3, "numbers in sentences are rounded to three or more digits; the tables hold them in full")


@dataclass(frozen=True)
class Artefact:
    """The text of one file and how it is compared with an earlier one."""

    text: str
    comparison: Comparison


def produce(name: str, study: Study, parameters: Any, identity: Identity) -> dict[str, Artefact]:
    """Compute, draw and judge: file name -> artefact, the description last."""
    from rkverify.workflow.style import svg

    tables = study.compute(parameters)
    files = {f"{key}.csv": Artefact(table.text(), table.comparison) for key, table in tables.items()}
    files |= {file: Artefact(text, Exact()) for file, text in study.documents(parameters, tables).items()}
    drawings = study.draw(parameters, tables)
    for key, drawing in drawings.items():
        files[f"{key}.svg"] = Artefact(svg(drawing.figure, study.title, drawing.alternative), VISUAL)
    statements = [asdict(statement) for statement in study.judge(parameters, tables)]
    names = [statement["name"] for statement in statements]
    if len(set(names)) != len(names):
        raise ValueError(f"study {name!r} makes two statements of the same name: {sorted(names)}")
    files[STATEMENTS] = Artefact(canonical(statements), WORDS)
    description = {
        "study": name,
        "title": study.title,
        "tables": {
            f"{key}.csv": {"caption": table.caption, "columns": [asdict(column) for column in table.columns_of_file]}
            for key, table in tables.items()
        },
        "figures": {
            f"{key}.svg": {"caption": drawing.caption, "alternative": drawing.alternative}
            for key, drawing in drawings.items()
        },
        "comparison": {file: artefact.comparison.record() for file, artefact in files.items()},
        "provenance": asdict(identity),
    }
    files[DESCRIPTION] = Artefact(canonical(description), Exact())
    return files

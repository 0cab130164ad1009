"""Mutants by the operators of Cosmic Ray: for each place in a file where one applies, what the file becomes.

Run by `mutants.py` in an environment of its own (controls/mutants.lock): python mutate.py ROOT SEED COUNT FILE …
Prints JSON: how many places there are, and a sample of mutants, {"file", "line", "place", "operator", "old", "new"} with the
lines that change. The sample is stratified: every file has its share by the number of its places, at least one.
"""

import ast
import json
import random
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from cosmic_ray.ast import ast_nodes, get_ast
from cosmic_ray.mutating import mutate_code
from cosmic_ray.plugins import get_operator, operator_names

NO_NUMBERS = ("Shift", "BitOr", "BitAnd", "BitXor", "Invert", "_Is", "RemoveDecorator", "Variable", "ExceptionReplacer")
"""Operators left out: bits and identities are no operations on numbers, so that most of these mutants are no programs."""

Place = tuple[int, int, int, int]


def operators() -> dict[str, Any]:
    """The operators that are used, by name."""
    names = [name for name in operator_names() if not any(word in name for word in NO_NUMBERS)]
    return {name: get_operator(name)() for name in names if not get_operator(name).arguments()}


def spans_without_code(text: str) -> list[Place]:
    """Annotations, decorators and `strict` of zip, which looks for a slip of the program's and changes no number."""
    found = []
    for node in ast.walk(ast.parse(text)):
        parts: list[ast.AST | None] = []
        if isinstance(node, ast.arg):
            parts.append(node.annotation)
        if isinstance(node, ast.FunctionDef):
            parts += [node.returns, *node.decorator_list]
        if isinstance(node, ast.ClassDef):
            parts += node.decorator_list
        if isinstance(node, ast.AnnAssign):
            parts.append(node.annotation)
        if isinstance(node, ast.keyword) and node.arg == "strict":
            parts.append(node.value)
        found += [(p.lineno, p.col_offset, p.end_lineno or 0, p.end_col_offset or 0) for p in parts if p is not None]  # type: ignore[attr-defined]
    return found


def places(text: str) -> Iterator[tuple[Place, str, int]]:
    """Place, operator and its occurrence, for all mutants of a text."""
    idle = spans_without_code(text)
    tree = get_ast(text)
    for name, operator in operators().items():
        spots = (spot for node in ast_nodes(tree) for spot in operator.mutation_positions(node))
        for occurrence, (start, end) in enumerate(spots):
            if not any((a, b) <= start and end <= (c, d) for a, b, c, d in idle):
                yield (*start, *end), name, occurrence


def shares(counts: dict[str, int], wanted: int) -> dict[str, int]:
    """How many of `wanted` each file has: proportional to its number of places, at least one."""
    total = sum(counts.values())
    return {name: max(1, round(wanted * count / total)) for name, count in counts.items() if count}


def changed(before: str, after: str) -> tuple[int, str, str]:
    """The first line that differs, and the lines that do, before and after."""
    old, new = before.splitlines(), after.splitlines()
    first = next(k for k in range(min(len(old), len(new))) if old[k] != new[k])
    last = next(k for k in range(min(len(old), len(new)) - first) if old[-1 - k] != new[-1 - k])
    return first + 1, "\n".join(old[first : len(old) - last]), "\n".join(new[first : len(new) - last])


def main(root: Path, seed: int, wanted: int, files: list[str]) -> None:
    """Print the sample."""
    chance = random.Random(seed)
    texts = {file: (root / file).read_text(encoding="utf-8") for file in files}
    known: dict[str, dict[Place, list[tuple[str, int]]]] = {}
    for file, text in texts.items():
        for place, name, occurrence in places(text):
            known.setdefault(file, {}).setdefault(place, []).append((name, occurrence))
    counts = {file: len(found) for file, found in known.items()}
    sample = []
    for file, share in shares(counts, wanted).items():
        for place in sorted(chance.sample(sorted(known[file]), min(share, counts[file]))):
            name, occurrence = chance.choice(known[file][place])
            after = mutate_code(texts[file], get_operator(name)(), occurrence)
            line, old, new = changed(texts[file], after)
            sample.append(
                {"file": file, "line": line, "place": place, "operator": name, "old": old, "new": new, "text": after}
            )
    print(json.dumps({"places": sum(counts.values()), "files": len(counts), "sample": sample}))


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]), sys.argv[4:])

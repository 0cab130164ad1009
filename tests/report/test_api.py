"""The page of public functions: everything that it names exists and is documented, every example prints what it shows.

A page that is written by hand promises what the code once did.
"""

import pytest

from rkverify.errors import BadInput
from rkverify.paths import checkout
from rkverify.report import api


@pytest.fixture(scope="module")
def parts():
    return api.parts(checkout())


def test_every_function_is_described_and_linked_to_its_line(parts) -> None:
    found = [one for part in parts for one in part.public]
    assert len({(one.module, one.name) for one in found}) == len(found) > 30
    for one in found:
        assert one.line.strip(), one.name
        assert one.signature.startswith(f"{one.name}(")
        assert "ndarray" not in one.signature
        assert " at 0x" not in one.signature, "it is another in every build"
        assert f"{one.module.replace('.', '/')}" in one.link.href
        assert one.link.line > 0


def test_every_part_has_an_example_that_is_run(parts) -> None:
    assert all(part.example.startswith(">>> ") for part in parts)


@pytest.mark.parametrize(
    ("example", "told"),
    [
        (">>> 1 + 1\n3\n", "does not print what it shows: .*Expected: 3 Got: 2"),
        (">>> no_such_name\n", "does not print what it shows: .*NameError"),
    ],
)
def test_an_example_that_prints_something_else_stops_the_build(example: str, told: str) -> None:
    with pytest.raises(BadInput, match=told) as refused:
        api._run("Part", example, {})
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("name", ["rkverify.no_such.thing", "rkverify.kernels.no_such", "rkverify.report.api.PARSER"])
def test_a_name_that_is_not_there_or_not_documented_is_told(name: str) -> None:
    with pytest.raises(BadInput, match=f"api.toml names {name}"):
        api.public(checkout(), name)


def test_examples_of_docstrings_are_shown_as_they_are_written() -> None:
    one = api.public(checkout(), "rkverify.arithmetic.named.arithmetic")
    assert one.example == ">>> arithmetic(\"mp:50\").name\n'mp:50'"

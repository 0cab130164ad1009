"""Names of arithmetics as the command line spells them."""

import pytest

from rkverify.arithmetic.named import NAMED, arithmetic
from rkverify.errors import BadInput, UnknownName


@pytest.mark.parametrize("name", ["float", "exact", "mp:1", "mp:50", "ball:30"])
def test_a_name_makes_the_arithmetic_that_carries_it(name: str) -> None:
    """Decides that a result's label says in which arithmetic it was computed."""
    assert arithmetic(name).name == name


def test_every_name_in_the_list_is_one() -> None:
    for name, (_, cls, wants_digits) in NAMED.items():
        assert type(arithmetic(f"{name}:20" if wants_digits else name)).__name__ == cls


@pytest.mark.parametrize("name", ["", "double", "MP:5", " mp:5", ":5", "series:3", "complex"])
def test_unknown_names_list_the_known_ones(name: str) -> None:
    with pytest.raises(UnknownName, match=r"choose one of ball:DIGITS, exact, float, mp:DIGITS"):
        arithmetic(name)


@pytest.mark.parametrize(
    "name",
    ["mp", "mp:", "mp:0", "mp:-1", "mp:x", "mp:1e3", "mp:5:5", "mp:1.5", "mp:²", "ball", "ball:", "ball:0", "ball:²"],
)
def test_missing_or_unusable_digits_say_how_to_write_them(name: str) -> None:
    """Decides that every spelling mistake is answered in our words; '²' is a digit to str.isdigit and none to int."""
    stem = name.split(":")[0]
    with pytest.raises(BadInput, match=f"write {stem}:DIGITS, for instance {stem}:50"):
        arithmetic(name)


@pytest.mark.parametrize("name", ["float:3", "float:", "exact:50"])
def test_digits_where_none_belong(name: str) -> None:
    with pytest.raises(BadInput, match=f"write {name.split(':')[0]}$"):
        arithmetic(name)

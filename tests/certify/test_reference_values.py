"""Reference values judge other people's codes: they must be right, come out the same everywhere, and see every fault."""

import hashlib
import json
import os
import subprocess
import sys
from dataclasses import replace
from fractions import Fraction
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from rkverify.arithmetic.multiprecision import Multiprecision
from rkverify.certify.certified import interval, scientific
from rkverify.certify.reference import in_doubles
from rkverify.certify.reference.agreement import distances
from rkverify.certify.reference.case import DIGITS, canonical
from rkverify.certify.reference.catalogue import FAMILIES, Case, family
from rkverify.certify.reference.writing import COLUMNS, document, rows
from rkverify.errors import Undecided, UnknownName
from rkverify.kernels import KERNELS, Kernel, Term, TruncatedPowers
from rkverify.stability.bloch.loading import Loading
from rkverify.stability.bloch.scheme import Scheme

ROOT = Path(__file__).resolve().parents[2]
SUBJECTS = {subject.name: subject for make in FAMILIES.values() for subject in make()}
QUICK = ("kernels", "rates", "gradients", "equations")
SAMPLE = (
    "line, own supports, order 2", "plane, order 1", "rates in the plane", "smoothed gradients of a pentagon, gauss:3",
    "smoothed gradients of a box, trapezoid", "plate, scni", "(63), R = 5/2",
    "printed, dni (diffuse), R = 7/4, sigma/C = 1/2, Q = 1", "consistent, scni (edge), R = 7/4, sigma/C = 1/4, Q = 1/2",
    "kernel quintic", "bar, scni", "square lattice, snni, midpoint; measure edges, cubic, R = 7/4, truesdell",
    "square lattice, scni, trapezoid, quintic, R = 7/4, jaumann",
)  # fmt: skip


def test_the_sample_has_a_case_of_every_family():
    assert {family for family, make in FAMILIES.items() if {s.name for s in make()} & set(SAMPLE)} == set(FAMILIES)


@cache
def case(name):
    return Case(SUBJECTS[name], SUBJECTS[name].certify())


@pytest.mark.parametrize("name", SAMPLE)
def test_digits_are_right_at_twice_the_precision_again(name):
    """The transcription with 160 digits: every printed number is within one unit of its last digit."""
    found, precise = case(name), SUBJECTS[name].literal(Multiprecision(4 * DIGITS))
    for quantity, number in found.values.items():
        true = interval(precise[quantity])[0]
        unit = Fraction(1, 10**30) if number.text == "0" else scientific(number.value, number.digits)[1]
        assert abs(number.value - true) <= unit, quantity
        assert number.digits == 30


def test_one_wrong_digit_is_seen():
    """The twin: the last digit but one changed is more than a unit away."""
    number = case("rates in the plane").values["true_rate[0][12]"]
    text = number.text
    at = text.index("e") - 2
    wrong = text[:at] + ("1" if text[at] != "1" else "3") + text[at + 1 :]
    assert abs(Fraction(wrong) - number.value) > scientific(number.value, 30)[1]


@pytest.mark.parametrize("name", QUICK)
def test_double_precision_is_within_the_computed_bound(name):
    """`solid/` had no part in the values: agreement to rounding is evidence for both. A bound never approached says little."""
    found = distances(family(name))
    assert [d for d in found if not d.within] == []
    assert any(d.error * 1000 >= d.bound > 0 for d in found)
    assert len(found) == sum(len(c.values) for c in family(name))


@pytest.mark.parametrize("name", [n for n in SAMPLE if n.startswith(("line", "plane", "consistent", "square"))])
def test_shape_functions_and_symbols_in_doubles(name):
    found = distances([case(name)])
    assert found
    assert [d for d in found if not d.within] == []


def test_files_are_the_same_in_another_process():
    """Byte for byte, whatever the seed of Python's hashes."""
    names = ("kernels", "rates", "gradients")
    code = (
        "import sys; from rkverify.certify.reference.catalogue import family\n"
        "from rkverify.certify.reference.writing import document, rows\n"
        f"for name in {names}: sys.stdout.write(document(name, family(name)) + repr(rows(family(name))))"
    )
    here = "".join(document(name, family(name)) + repr(rows(family(name))) for name in names)
    for seed in ("1", "2"):
        run = subprocess.run(
            [sys.executable, "-c", code], env={**os.environ, "PYTHONHASHSEED": seed}, cwd=ROOT, capture_output=True, check=True
        )  # fmt: skip
        assert hashlib.sha256(run.stdout).hexdigest() == hashlib.sha256(here.encode()).hexdigest()


def test_the_second_route_shares_nothing_with_the_first():
    """Its modules load neither the transcription, nor the vectorised code, nor the kernels' data."""
    names = ("by_definition", "cells_by_definition", "waves_by_definition", "lattice_by_definition")
    code = (
        "; ".join(f"import rkverify.certify.reference.{name}" for name in names) + "; import sys; print(*sys.modules)"
    )
    run = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    ours = {name for name in run.stdout.split() if name.startswith("rkverify.")}
    assert not [name for name in ours if name.startswith(("rkverify.paper", "rkverify.solid", "rkverify.kernels", "rkverify.stability"))]  # fmt: skip


def test_doubles_hold_the_inputs_of_shape_functions_exactly():
    """A difference is then one of codes, not of data."""

    def numbers(data):
        if isinstance(data, list):
            return [n for part in data for n in numbers(part)]
        return [Fraction(data)]

    keys = ("nodes", "supports", "points", "velocity", "node_velocities", "cell", "cells", "displacements", "edges")
    found = [q for s in SUBJECTS.values() for key in keys if key in s.inputs for q in numbers(s.inputs[key])]
    assert len(found) > 1000
    assert [q for q in found if Fraction(float(q)) != q] == []


def test_names_are_unique_and_cells_split_at_commas():
    assert len(SUBJECTS) == sum(len(make()) for make in FAMILIES.values())
    for row in rows(family("gradients")):
        assert tuple(row) == COLUMNS
        assert not any("," in str(cell) or '"' in str(cell) for cell in row.values())


def test_hashes_are_those_of_the_published_inputs():
    """Whoever reads the JSON can compute them; another input has another hash."""
    for read in json.loads(document("rates", family("rates")))["cases"]:
        assert hashlib.sha256(canonical(read["inputs"]).encode()).hexdigest() == read["inputs_sha256"]
        read["inputs"]["order"] += 1
        assert hashlib.sha256(canonical(read["inputs"]).encode()).hexdigest() != read["inputs_sha256"]


def test_an_unknown_family_is_named():
    with pytest.raises(UnknownName, match="no-such"):
        family("no-such")


def test_a_node_that_one_route_misses_is_an_error():
    subject = SUBJECTS["rates on a line, order 1"]
    lost = replace(subject, literal=lambda K: dict(list(subject.literal(K).items())[1:]))
    with pytest.raises(Undecided, match="a node that was missed"):
        lost.certify()


def test_routes_that_part_are_an_error():
    """Psi* for the true rate, in one route."""
    subject = SUBJECTS["rates on a line, order 1"]

    def star_twice(K):
        found = subject.literal(K)
        return {name: found[name.replace("true_rate", "psi_star")] for name in found}

    with pytest.raises(Undecided, match="digit"):
        replace(subject, literal=star_twice).certify()


def _kernel_off(monkeypatch):
    def spoilt(given):
        phi = KERNELS["cubic"].phi.terms
        off = Term(phi[0].coefficient * (1 + Fraction(1, 10**6)), phi[0].end, 3)
        return replace(cloud(given), kernel=Kernel("cubic", TruncatedPowers((off, *phi[1:])), ""))

    cloud = in_doubles._cloud
    monkeypatch.setattr(in_doubles, "_cloud", spoilt)


def _cells(change):
    def fault(monkeypatch):
        given = in_doubles.polygon_cells
        monkeypatch.setattr(in_doubles, "polygon_cells", lambda rings: change(given(rings)))

    return fault


def _one_normal_turned(cells):
    areas = cells.areas.copy()
    areas[0] *= -1
    return replace(cells, areas=areas)


def _cloud(change):
    def fault(monkeypatch):
        given = in_doubles._cloud
        monkeypatch.setattr(in_doubles, "_cloud", lambda inputs: change(given(inputs)))

    return fault


def _one_neighbour_missed(nodes):
    supports = nodes.supports.copy()
    supports[7] = 0.01
    return replace(nodes, supports=supports)


def _put(name, value):
    return lambda monkeypatch: monkeypatch.setattr(in_doubles, name, value)


def _shape(change):
    def fault(monkeypatch):
        given = in_doubles.shape
        monkeypatch.setattr(in_doubles, "shape", change(given))

    return fault


def _rule(monkeypatch):
    given = in_doubles.scni
    monkeypatch.setattr(in_doubles, "scni", lambda nodes, cells, rule: given(nodes, cells, "midpoint"))


def _transposed(monkeypatch):
    law = in_doubles.SaintVenantKirchhoff
    given = law.stress
    monkeypatch.setattr(law, "stress", lambda self, F: given(self, F).swapaxes(1, 2))


def _shifted_stencil(monkeypatch):
    given = in_doubles.jacobian_solid.stencil
    shifted = lambda base: {key: {n + 1: c for n, c in part.items()} for key, part in given(base).items()}  # noqa: E731
    monkeypatch.setattr(in_doubles.jacobian_solid, "stencil", shifted)


PLANE, DIRECT = "plane, order 1", "direct gradients in 2-D, full"
PENTAGON, WAVE = "smoothed gradients of a pentagon, trapezoid", SAMPLE[8]
SQUARES, SIDES = SAMPLE[-2:]


def _diffuse(shape):
    def instead(nodes, points, derivatives=0, reading="full"):
        full = shape(nodes, points, derivatives, reading)
        return full if full.gradients is None else replace(full, gradients=shape(nodes, points, 1, "diffuse").gradients)

    return instead


FAULTS = {
    "a coefficient of the kernel off by 1e-6": (_kernel_off, PENTAGON),
    "the sign of a normal": (_cells(_one_normal_turned), PENTAGON),
    "the diffuse derivative sold as the full one": (_shape(_diffuse), DIRECT),
    "the correction missing": (_cloud(lambda nodes: replace(nodes, order=0)), DIRECT),
    "the midpoint for the trapezoid": (_rule, PENTAGON),
    "J missing: measures of one": (_cells(lambda cells: replace(cells, measures=np.ones_like(cells.measures))), "plate, scni"),
    "Psi* for the true rate": (_put("true_rate", in_doubles.psi_star), "rates in the plane"),
    "the stress transposed": (_transposed, "plate, scni"),
    "a neighbour missed": (_cloud(_one_neighbour_missed), DIRECT),
    "stale cells": (_cells(lambda cells: replace(cells, vertices=cells.vertices - 2.0**-20)), PENTAGON),
    "a shifted stencil": (_shifted_stencil, WAVE),
    "the corotation of another law": (_put("Loading", lambda stress, moduli, law: Loading(stress, moduli, "truesdell")), SIDES),
    "the measure of a cell that does not move": (_put("Scheme", lambda *a: Scheme(*a[:4], "fixed", *a[5:])), SQUARES),
    "the midpoint of a side for its ends": (_put("Scheme", lambda *a: Scheme(*a[:2], "midpoint", *a[3:])), SIDES),
    "the radial window for the tensor one": (_cloud(lambda nodes: replace(nodes, window="radial")), "plane, tensor window, order 1"),
    "a support off by the rounding of single precision": (_cloud(lambda nodes: replace(nodes, supports=nodes.supports * (1 + 2.0**-25))), DIRECT),
}  # fmt: skip


@pytest.mark.parametrize("name", FAULTS)
def test_every_fault_of_the_catalogue_is_beyond_the_bound(name, monkeypatch):
    """A fault in double precision moves some value farther than rounding can, so that a user sees it too."""
    fault, on = FAULTS[name]
    good = case(on)
    assert all(d.within for d in distances([good]))
    fault(monkeypatch)
    assert any(not d.within for d in distances([good]))


def test_single_precision_anywhere_is_beyond_the_bound(monkeypatch):
    """Every value through single precision, as where one array has the wrong type."""
    given = in_doubles.doubles
    monkeypatch.setattr(
        "rkverify.certify.reference.agreement.doubles",
        lambda *a: {k: float(np.float32(v)) for k, v in given(*a).items()},
    )
    found = distances([case(PLANE)])
    assert sum(not d.within for d in found) > len(found) / 2

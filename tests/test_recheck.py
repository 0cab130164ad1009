"""The checker of proof logs: it must accept what the provers wrote, and nothing that proves less than it claims.

A checker that only compares hashes would accept a false theorem from whoever can compute one: every damage is done twice,
as it is, where the hash tells it, and with the hash made anew, where the proof itself must.
"""

import copy
import hashlib
import json
import subprocess
import sys
from fractions import Fraction
from pathlib import Path

import pytest

from rkverify.cli import main
from rkverify.errors import BadInput
from rkverify.recheck import RULES, recheck
from rkverify.recheck.boxes import enclosed, positive_on_tree, zeros_inside
from rkverify.recheck.polynomials import determinant, discriminant
from rkverify.recheck.reading import Rejected

FOLDER = Path(__file__).resolve().parents[1] / "reports" / "results" / "theorems"
FAMILIES = ("reproduction", "kernels", "scni", "printed", "at_pi", "tension", "motion")


def signed(theorems):
    """A log of these theorems with the hash that belongs to it, written without the provers' code."""
    log = {"format": "rkverify proof log 1", "theorems": theorems}
    text = json.dumps(log, sort_keys=True, ensure_ascii=False, separators=(",", ":"))
    return json.dumps(log | {"sha256": hashlib.sha256(text.encode()).hexdigest()})


def committed(family):
    return (FOLDER / f"{family}.json").read_text(encoding="utf-8")


def theorem(name):
    """A theorem of the committed logs, as data that may be spoilt."""
    for family in FAMILIES:
        for found in json.loads(committed(family))["theorems"]:
            if found["name"] == name:
                return copy.deepcopy(found)
    raise LookupError(name)


def place(data, path):
    for key in path[:-1]:
        data = data[key]
    return data, path[-1]


@pytest.mark.parametrize("family", FAMILIES)
def test_what_is_committed_is_verified(family):
    """Every committed theorem, and at least one in each log."""
    found = recheck(committed(family))
    assert [name for name, _ in found] == [t["name"] for t in json.loads(committed(family))["theorems"]]


PIECE = ("proof", "pieces", 0)
CHANGED = [
    ("kernel-cubic", (*PIECE, "polynomial", 2), -5, "not the cubic kernel"),
    ("kernel-quartic", ("claim", "curvature_zeros", 0, 0), "1/4", "claimed"),
    ("dni-at-pi-cubic-full", (*PIECE, "numerator", 3), 7, "not the function"),
    ("dni-at-pi-cubic-full", (*PIECE, "denominator", 0), 7, "not the function"),
    ("dni-at-pi-cubic-full", (*PIECE, "zeros", 0, 1), "3/2", "not the two ends"),
    ("dni-at-pi-cubic-full", ("claim", "signs", 0), 1, "the signs are"),
    ("dni-window-cubic", ("proof", "surface", 1, 2), 7, "coefficients of c"),
    ("dni-window-cubic", ("proof", "constant"), 7, "discriminant"),
    ("dni-window-cubic", ("claim", "counts", 0), 2, "numbers of zeros"),
    ("dni-greatest-tension-5-2", ("claim", "subject", "R"), "9/4", "coefficients of c"),
    ("room-for-growth-true-Q<0", (*PIECE, "surface", 0, 1), 7, "coefficients of c"),
    ("printed-scni-not-negative", ("proof", "parts", 0, "weight", 0), "3/2", "do not add up"),
    ("printed-scni-not-negative", ("proof", "parts", 0, "weight", 0), -1, "may be negative"),
    ("moment-matrix-2-functions-3-nodes", ("proof", "sum", 0, 0), 2, "the sum that is listed"),
    ("counterexample-45", ("proof", "polynomial", 0), 1, "not the polynomial"),
    ("counterexample-45", ("claim", "signs"), [-1, 1, 1], "the signs are"),
    ("dni-form-cubic-full", ("proof", "pieces", 0, 1), "3/2", "nothing covers"),
    ("scni-gradient-not-zero", (*PIECE, "surface", 0, 0), 7, "coefficients of c"),
]
WIDER = [
    ("kernel-cubic", ("claim", "continuity"), 3, "class C"),
    ("kernel-cubic", ("claim", "kernel"), "quartic", "joints"),
    ("dni-at-pi-cubic-full", ("claim", "to"), 5, "nothing covers"),
    ("dni-at-pi-cubic-full", ("claim", "from"), "1/2", "nothing covers"),
    ("dni-at-pi-cubic-full", ("claim", "digits"), 40, "wider than"),
    ("dni-at-pi-cubic-full", ("claim", "zeros"), [], "the zeros that are claimed"),
    ("dni-at-pi-cubic-diffuse", ("claim", "subject", "derivative"), "full", "not the function"),
    ("Psi(h) < 1/4-cubic", ("claim", "to"), 3, "nothing covers"),
    ("dni-form-cubic-full", ("claim", "to"), 3, "nothing covers"),
    ("dni-window-cubic", ("claim", "to"), 4, "nothing covers"),
    ("dni-window-cubic", ("claim", "turns"), [], "number of zeros changes"),
    ("room-for-growth-true-Q<0", ("claim", "subject", "growth"), "9/5", "coefficients of c"),
    ("scni-gradient-not-zero", ("claim", "to"), 4, "nothing covers"),
    ("printed-scni-not-negative", ("claim", "relation"), "dni-printed-limit", "do not add up"),
    ("counterexample-45", ("claim", "subject", "Q"), 0, "not the polynomial"),
    ("moment-matrix-3-functions-2-nodes", ("claim", "nodes"), 3, "the sum that is listed"),
    ("scni-zero-at-pi-3", ("claim", "identity"), "first-moment", "the sum that is listed"),
    ("scni-telescopes-8", ("claim", "equals"), "0", "is not 0"),
]


@pytest.mark.parametrize(("name", "path", "wrong", "told"), [*CHANGED, *WIDER])
def test_a_changed_digit_or_a_wider_claim_is_refused(name, path, wrong, told):
    spoilt = theorem(name)
    data, key = place(spoilt, path)
    assert data[key] != wrong
    data[key] = wrong
    with pytest.raises(BadInput, match=told) as refused:
        recheck(signed([spoilt]))
    assert "\n" not in str(refused.value)


REMOVED = [
    ("kernel-cubic", (*PIECE, "slope_boxes", 0)),
    ("dni-at-pi-cubic-full", (*PIECE, "boxes", 0)),
    ("dni-at-pi-cubic-full", (*PIECE, "denominator_boxes", -1)),
    ("dni-at-pi-cubic-full", ("proof", "pieces", 1)),
    ("dni-window-cubic", ("proof", "factors", 0)),
    ("dni-window-cubic", ("proof", "samples", 0)),
    ("dni-window-cubic", ("proof", "left", 0)),
    ("dni-window-cubic", ("proof", "samples", 1, "boxes", 0)),
    ("printed-dni-compressed", ("proof", "parts", 2)),
    ("dni-long-waves-full", ("proof", "pieces", 1)),
    ("moment-matrix-2-functions-3-nodes", ("proof", "sum", 4)),
    ("scni-gradient-not-zero", ("proof", "pieces", 1)),
    ("room-for-growth-true-Q<0", (*PIECE, "denominator_boxes", 0)),
    ("counterexample-45", ("proof", "boxes", 0)),
]


@pytest.mark.parametrize(("name", "path"), REMOVED)
def test_a_missing_step_is_refused(name, path):
    spoilt = theorem(name)
    data, key = place(spoilt, path)
    del data[key]
    with pytest.raises(BadInput):
        recheck(signed([spoilt]))


@pytest.mark.parametrize(
    ("spoil", "told"),
    [
        (lambda tree: tree[:-1], "1 boxes of the rectangle are missing"),
        (lambda tree: tree + "+", "beyond the rectangle"),
        (lambda tree: "+", "not positive"),
        (lambda tree: "z" + tree, "none of"),
        (lambda tree: 7, "no text"),
    ],
)
def test_a_tree_of_boxes_covers_its_rectangle(spoil, told):
    spoilt = theorem("room-for-growth-psi-star-Q<0")
    piece = spoilt["proof"]["pieces"][0]
    assert len(piece["tree"]) > 3, "a single box would not show it"
    piece["tree"] = spoil(piece["tree"])
    with pytest.raises(BadInput, match=told):
        recheck(signed([spoilt]))


TWO = [Fraction(2), Fraction(-9), Fraction(9)]
"""(3 x - 1)(3 x - 2)."""


@pytest.mark.parametrize(
    ("boxes", "told"),
    [
        ([[0, 1, 0]], "2 changes of sign, 0 claimed"),
        ([[0, 1, 2]], "more than one change of sign"),
        ([[0, "1/2", True], ["1/2", 1, 1]], "changes of sign"),
        ([[0, "1/3", 0], ["1/3", "1/2", 0], ["1/2", 1, 1]], "zero at 1/3, between two boxes"),
        ([[0, "1/2", 1], ["3/4", 1, 0]], "nothing covers the place after 1/2"),
        ([[0, "1/2", 1]], "nothing covers the place after 1/2"),
        ([["1/4", "1/2", 1], ["1/2", 1, 1]], "nothing covers the place after 0"),
        ([[0, "2/3", 1], ["1/2", 1, 1]], "nothing covers the place after 2/3"),
        ([[0, 0, 0], [0, "1/2", 1], ["1/2", 1, 1]], "nothing covers"),
        ([[0, "1/2"]], "two ends and a count"),
        ("boxes", "no list"),
    ],
)
def test_boxes_that_hide_a_zero_are_refused(boxes, told):
    """Every way to leave out one of two zeros; the honest boxes find both."""
    ends = Fraction(0), Fraction(1)
    assert len(zeros_inside(TWO, [[0, "1/2", 1], ["1/2", 1, 1]], *ends, "p")) == 2
    with pytest.raises(BadInput, match=told):
        zeros_inside(TWO, boxes, *ends, "p")


@pytest.mark.parametrize(
    ("zero", "told"),
    [(["2/5", "9/20"], "no change of sign"), (["1/4", "3/4"], "not enclosed"), (["1/4", "9/20"], "wider than 1e-1")],
)
def test_an_enclosure_holds_its_zero(zero, told):
    box = Fraction(0), Fraction(1, 2)
    assert enclosed(["1/3", "1/3"], TWO, box, 30, "p") == (Fraction(1, 3), Fraction(1, 3))
    with pytest.raises(BadInput, match=told):
        enclosed(zero, TWO, box, 1, "p")


def test_a_sample_lies_in_its_stretch():
    """The count beside the turn says nothing of the stretch behind it."""
    spoilt = theorem("dni-window-cubic")
    samples = spoilt["proof"]["samples"]
    samples[-1] = samples[0]
    with pytest.raises(BadInput, match="is not between"):
        recheck(signed([spoilt]))


def numbers(data, path=()):
    """The places of all numbers in a theorem, texts of fractions among them."""
    if isinstance(data, dict | list):
        for key, inner in data.items() if isinstance(data, dict) else enumerate(data):
            yield from numbers(inner, (*path, key))
    elif isinstance(data, int) or (isinstance(data, str) and data.lstrip("-").replace("/", "").isdigit()):
        yield path


def steps(data, path=()):
    """The places of all items of lists in a theorem: boxes, pieces, parts, terms."""
    if isinstance(data, dict | list):
        for key, inner in data.items() if isinstance(data, dict) else enumerate(data):
            if isinstance(data, list):
                yield (*path, key)
            yield from steps(inner, (*path, key))


def smallest():
    """Kind of claim -> the smallest committed theorem of that kind whose proof has a step."""
    found = {}
    for family in FAMILIES:
        for t in json.loads(committed(family))["theorems"]:
            kind, size = t["claim"]["kind"], len(json.dumps(t))
            if list(steps(t["proof"])) and size < found.get(kind, (size + 1, None))[0]:
                found[kind] = size, t
    return {kind: t for kind, (_, t) in found.items()}


SMALLEST = smallest()
MOST = 16
"""Damages of a proof that are tried, evenly over all of them: two kinds take a tenth of a second for each."""


def test_every_kind_of_claim_is_damaged_in_every_way():
    """A digit changed, a claim made wider, a step removed: a rule that none of the lists speaks of would go untested."""
    assert set(SMALLEST) == set(RULES)
    for damaged in (CHANGED, WIDER, REMOVED):
        assert {theorem(name)["claim"]["kind"] for name, *_ in damaged} == set(RULES)


@pytest.mark.parametrize("kind", RULES)
def test_no_damage_passes_in_any_kind_of_log(kind):
    """Numbers made others and steps left out, at all places of the claim and evenly over the proof; promised digits may be fewer."""
    whole = SMALLEST[kind]
    damages = []
    for part in ("claim", "proof"):
        places = [(False, (part, *path)) for path in numbers(whole[part])]
        places += [(True, (part, *path)) for path in steps(whole[part])]
        damages += places if part == "claim" else places[:: -(-len(places) // MOST)]
    accepted, told = [], []
    for removed, path in damages:
        spoilt = copy.deepcopy(whole)
        data, key = place(spoilt, path)
        if removed:
            del data[key]
        else:
            data[key] = data[key] - 1 if isinstance(data[key], int) else "7/3"
        try:
            recheck(signed([spoilt]))
        except BadInput as refused:
            told.append(str(refused))
            continue
        accepted.append(path)
    assert len(told) > 4
    assert not [line for line in told if "\n" in line or len(line) > 300]
    assert [path for path in accepted if path != ("claim", "digits")] == []


@pytest.mark.parametrize("family", FAMILIES)
def test_a_digit_or_the_end_of_a_log_is_missed_by_its_hash(family):
    """In the text itself, somewhere in the middle of the log."""
    text = committed(family)
    at = next(k for k in range(len(text) // 2, len(text)) if text[k].isdigit())
    with pytest.raises(BadInput, match="wrong hash"):
        recheck(text[:at] + str((int(text[at]) + 1) % 9 + 1) + text[at + 1 :])
    with pytest.raises(BadInput, match="no complete JSON"):
        recheck(text[: -len(text) // 3])


@pytest.mark.parametrize(
    "name", ["kernel-wendland-c4", "dni-at-pi-cubic-diffuse", "printed-scni-exact-set", "example-50"]
)
def test_every_number_counts(name):
    """Each number in turn is made another: only a promise of fewer digits is still true."""
    whole = theorem(name)
    accepted = []
    for path in numbers({"claim": whole["claim"], "proof": whole["proof"]}):
        spoilt = copy.deepcopy(whole)
        data, key = place(spoilt, path)
        data[key] = data[key] - 1 if isinstance(data[key], int) else "7/3"
        try:
            recheck(signed([spoilt]))
        except BadInput:
            continue
        accepted.append(path)
    assert [path for path in accepted if path != ("claim", "digits")] == []


LOG = committed("kernels")
DAMAGED = [
    (LOG[: len(LOG) // 2], "no complete JSON"),
    ("", "no complete JSON"),
    ("\x00\x01", "no complete JSON"),
    (LOG.replace("polynomial", "polynomiaL", 1), "wrong hash"),
    (LOG.replace('"sha256":"', '"sha256":"0', 1), "wrong hash"),
    (LOG.replace('"digits":30', '"digits":NaN', 1), "NaN"),
    (LOG.replace('"digits":30', '"digits":-Infinity', 1), "Infinity"),
    (LOG.replace('"digits":30', '"digits":1e999999999', 1), "1e999999999"),
    (LOG.replace('"digits":30', '"digits":3.0', 1), "write whole numbers"),
    (LOG.replace('"digits":30', '"digits":' + "9" * 5000, 1), "5000 digits"),
    (LOG.replace('"digits":30', '"digits":30,"digits":20', 1), "twice"),
    ("[" * 100000, "JSON|nested"),
    ('{"format": "rkverify proof log 2"}', "format"),
    ("[]", "format"),
    (signed([]), "no theorem"),
    (signed([7]), "'name' is missing"),
    (signed([{"name": "x", "claim": {"kind": "it is so"}, "proof": {}}]), "no rule"),
    (signed([{"name": "x", "claim": {"kind": []}, "proof": {}}]), "no rule"),
    (signed([{"name": "x", "claim": {"kind": "kernel", "kernel": "box"}, "proof": {}}]), "no kernel"),
    (signed([{"name": "x", "claim": {"kind": "kernel", "kernel": ["cubic"]}, "proof": {}}]), "cannot hold"),
    ('{"format":"rkverify proof log 1","theorems":["\\ud800"]}', "wrong hash"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "told"), DAMAGED)
def test_a_damaged_log_gives_one_clear_line(text, told):
    with pytest.raises(BadInput, match=told) as refused:
        recheck(text)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 300


@pytest.mark.parametrize("number", ["nan", "1e9", "1/0", "0x10", "9" * 500, "", "1.5", " 1", "１"])
def test_only_fractions_of_a_bounded_size_are_numbers(number):
    spoilt = theorem("kernel-cubic")
    spoilt["proof"]["pieces"][0]["polynomial"][0] = number
    with pytest.raises(BadInput, match="no fraction"):
        recheck(signed([spoilt]))


def test_an_exponent_is_bounded():
    spoilt = theorem("printed-scni-not-negative")
    spoilt["proof"]["parts"][0]["square"][0][1] = {"a": 10**9}
    with pytest.raises(BadInput, match="exponent"):
        recheck(signed([spoilt]))


def test_a_theorem_that_is_refused_is_named():
    spoilt = theorem("kernel-cubic")
    spoilt["claim"]["continuity"] = 3
    with pytest.raises(Rejected, match="theorem 1, kernel-cubic: "):
        recheck(signed([theorem("kernel-tent"), spoilt]))


def test_words_in_a_log_count_for_nothing():
    """The sentence that comes back is the checker's own."""
    lying = theorem("kernel-cubic")
    lying["words"] = "the cubic kernel is analytic"
    ((_, said),) = recheck(signed([lying]))
    assert "class C^2 exactly" in said


def test_the_checker_loads_nothing_of_the_provers():
    """Neither their modules nor their libraries: an error there cannot agree with itself here."""
    code = "import sys, rkverify.recheck; print(*sorted(m.partition('.')[0] if m[:8] != 'rkverify' else m for m in sys.modules))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = set(done.stdout.split())
    own = {m for m in loaded if m.startswith("rkverify")}
    assert {m for m in own if not m.startswith("rkverify.recheck")} == {"rkverify", "rkverify.errors"}
    assert not loaded & {"numpy", "scipy", "sympy", "flint", "mpmath", "pandas"}


def test_the_command_names_the_file_and_ends_with_1(tmp_path, capsys):
    good, bad = tmp_path / "good.json", tmp_path / "bad.json"
    good.write_text(signed([theorem("kernel-cubic")]), encoding="utf-8")
    bad.write_text(LOG[:-9], encoding="utf-8")
    assert main(["recheck", str(good)]) == 0
    assert "class C^2" in capsys.readouterr().out
    assert main(["recheck", str(good), str(bad), str(tmp_path / "none.json")]) == 1
    told = capsys.readouterr()
    assert [line.startswith(f"rkverify: {tmp_path}") for line in told.err.splitlines()] == [True, True]
    assert "1 theorems verified, 2 of 3 logs refused" in told.out


UNREADABLE = {
    "truncated": LOG[:-9].encode(),
    "wrong hash": LOG.replace("polynomial", "polynomiaL", 1).encode(),
    "NaN": LOG.replace('"digits":30', '"digits":NaN', 1).encode(),
    "a huge exponent": LOG.replace('"digits":30', '"digits":1e999999999', 1).encode(),
    "no text": b"\xff\xfe" + LOG.encode(),
    "nothing": b"",
}


@pytest.mark.parametrize("damage", UNREADABLE)
def test_the_command_answers_damage_with_one_line_and_1(damage, tmp_path, capsys):
    """No traceback, no second line, the file named."""
    file = tmp_path / "log.json"
    file.write_bytes(UNREADABLE[damage])
    assert main(["recheck", str(file)]) == 1
    told = capsys.readouterr()
    assert told.err.count("\n") == 1
    assert told.err.startswith(f"rkverify: {file}: ")
    assert "0 theorems verified, 1 of 1 logs refused" in told.out
    assert main(["recheck", str(tmp_path)]) == 1
    assert capsys.readouterr().err.count("\n") == 1


def test_a_determinant_has_its_sign():
    """Rows exchanged on the way count, so that discriminants tell two real zeros from none: b^2 - 4 c, up to its factor -1."""
    assert determinant([[Fraction(0), Fraction(1)], [Fraction(1), Fraction(0)]]) == -1
    assert determinant([[Fraction(v) for v in row] for row in ([0, 2, 1], [3, 0, 1], [1, 1, 0])]) == 5
    assert [discriminant([Fraction(c), Fraction(b), Fraction(1)]) for b, c in ((3, 2), (0, 1), (2, 1))] == [-1, 4, 0]


def test_a_surface_that_touches_zero_is_not_positive():
    """The least Bernstein coefficient must be positive itself: 0 and just below it are refused, just above it is taken."""
    unit = (Fraction(0), Fraction(1))
    for least in ("1/1000", "0", "-1/1000"):
        P = [[Fraction(least), Fraction(1)], [Fraction(1)]]
        if Fraction(least) > 0:
            assert positive_on_tree(P, "+", unit, unit) == 1
        else:
            with pytest.raises(BadInput, match="not positive"):
                positive_on_tree(P, "+", unit, unit)

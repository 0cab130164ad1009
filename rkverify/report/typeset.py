"""Plain sentences as HTML: the names of Greek letters, indices, powers and comparisons as they are written on paper.

Statements stay in plain characters, which a terminal, a CSV file and LaTeX read; this is how the pages show them.
"""

import re

from markupsafe import Markup, escape

GREEK = {
    "Psi": "Ψ", "Gamma": "Γ", "Delta": "Δ", "phi": "φ", "omega": "ω", "sigma": "σ", "rho": "ρ", "lambda": "λ", "mu": "μ",
    "pi": "π", "delta": "δ", "kappa": "κ", "beta": "β", "Xi": "Ξ", "Omega": "Ω", "gamma": "γ",
}  # fmt: skip
LETTER = "|".join(GREEK)
BASE = rf"(?:[A-Za-z]{{1,2}}|sum|int|d?(?:{LETTER}))[\u0302-\u0308]*"
# A bar or a hat needs an index, a power or an argument after it: "that" and "what" are words.
ACCENTED = re.compile(rf"(?<![A-Za-z])(d?)({LETTER}|[A-Za-z])(bar|hat)?(~)?(ddot|dot)?(?![A-Za-z])(?(3)(?=[_^(]))")
MARKS = {"bar": "\u0304", "hat": "\u0302", "~": "\u0303", "dot": "\u0307", "ddot": "\u0308", None: ""}
"""Their names -> marks over the letter before."""
SIGNS = {"&lt;=": "≤", "&gt;=": "≥", "-&gt;": "→"}


def _sup(found: re.Match[str]) -> str:
    return f"<sup>{found['braces'] or found['part']}</sup>"


def typeset(words: object) -> Markup:
    """Words as HTML, everything else in them escaped.

    >>> str(typeset("omega^2 < 0 where C^sigma + sigma <= -1/2; Psi_I,x, `make test`"))
    'ω<sup>2</sup> &lt; 0 where C<sup>σ</sup> + σ ≤ −1/2; Ψ<sub>I</sub>,x, <code>make test</code>'

    Marks over a letter, and what stands in braces:

    >>> print(typeset("(u~_{I+1} - 2 u~_I), phidot_a, sum_{J=1..NP}, int_{Omega_L}, f_ext_I").replace("\u0303", "~").replace("\u0307", "."))
    (u~<sub>I+1</sub> − 2 u~<sub>I</sub>), φ.<sub>a</sub>, Σ<sub>J=1..NP</sub>, ∫<sub>Ω<sub>L</sub></sub>, f<sub>ext I</sub>

    Words, names with underscores, ranges and powers of ten in a number stay as they are.

    >>> str(typeset("What that says: two_routes_in_space, 16-20 nodes, 1e-12, wendland-c2"))
    'What that says: two_routes_in_space, 16-20 nodes, 1e-12, wendland-c2'
    """
    parts = str(escape(str(words))).split("`")
    if len(parts) % 2 == 0:  # a mark without its partner is a character as any other
        parts = ["`".join(parts)]
    return Markup("".join(f"<code>{p}</code>" if n % 2 else _formulas(p) for n, p in enumerate(parts)))


def _formulas(words: str) -> str:
    for plain, sign in SIGNS.items():
        words = words.replace(plain, sign)
    words = ACCENTED.sub(_accented, words)
    words = re.sub(r"(?<=[f\u0303])_(int|ext)_([A-Z])(?!\w)", r"_{\1 \2}", words)
    words = re.sub(r"(?<!\w)int (?=delta |d\()", "∫ ", words)
    words = re.sub(rf"(?<![\w.])({BASE}\*?)_([A-Za-z0-9]{{1,3}})(?!\w)", _sub, words)
    words = re.sub(rf"(?<![\w.])({BASE}\*?)_\{{([^{{}}]*)\}}", _sub, words)
    words = re.sub(r"(?:\^|\*\*)(?:\{(?P<braces>[^{}]*)\}|(?P<part>-?\w+|\(-?\d+/\d+\)))", _sup, words)
    words = re.sub(rf"(?<![A-Za-ce-z_&])(?:{LETTER})(?![A-Za-z_]|-[a-z])", lambda m: GREEK[m[0]], words)
    words = re.sub(r"(?<![\w*])\*(?=\w)|(?<=\d)\*(?=[A-Za-z(])|(?<=\))\*(?=[\w(])", "·", words)
    return re.sub(r"(?<![\w).-])-(?=[\d.]*\d)|(?<=[\s(\[])-(?=[\s\wα-ωΨ(])", "−", words)


def _sub(found: re.Match[str]) -> str:
    base = {"sum": "Σ", "int": "∫"}.get(found[1], found[1])
    return f"{base}<sub>{found[2]}</sub>"


def _accented(found: re.Match[str]) -> str:
    before, letter, *marks = found.groups()
    return before + letter + "".join(MARKS[mark] for mark in marks)

"""Plain sentences as HTML: the names of Greek letters, indices, powers and comparisons as they are written on paper.

Statements stay in plain characters, which a terminal, a CSV file and LaTeX read; this is how the pages show them.
"""

import re

from markupsafe import Markup, escape

GREEK = {
    "Psi": "Ψ", "Gamma": "Γ", "Delta": "Δ", "phi": "φ", "omega": "ω", "sigma": "σ", "rho": "ρ", "lambda": "λ", "mu": "μ",
    "pi": "π", "delta": "δ", "kappa": "κ", "beta": "β", "Xi": "Ξ",
}  # fmt: skip
LETTER = "|".join(GREEK)
BASE = rf"(?:[A-Za-z]{{1,2}}|sum|d?{LETTER})"
SIGNS = {"&lt;=": "≤", "&gt;=": "≥", "-&gt;": "→"}


def _sup(found: re.Match[str]) -> str:
    return f"<sup>{found['braces'] or found['part']}</sup>"


def typeset(words: object) -> Markup:
    """Words as HTML, everything else in them escaped.

    >>> str(typeset("omega^2 < 0 where C^sigma + sigma <= -1/2; Psi_I,x, `make test`"))
    'ω<sup>2</sup> &lt; 0 where C<sup>σ</sup> + σ ≤ −1/2; Ψ<sub>I</sub>,x, <code>make test</code>'

    Names with underscores, ranges and powers of ten in a number stay as they are.

    >>> str(typeset("two_routes_in_space, 16-20 nodes, 1e-12, wendland-c2"))
    'two_routes_in_space, 16-20 nodes, 1e-12, wendland-c2'
    """
    parts = str(escape(str(words))).split("`")
    if len(parts) % 2 == 0:  # a mark without its partner is a character as any other
        parts = ["`".join(parts)]
    return Markup("".join(f"<code>{p}</code>" if n % 2 else _formulas(p) for n, p in enumerate(parts)))


def _formulas(words: str) -> str:
    for plain, sign in SIGNS.items():
        words = words.replace(plain, sign)
    words = re.sub(rf"(?<![\w.])({BASE}\*?)_([A-Za-z0-9]{{1,3}})(?!\w)", _sub, words)
    words = re.sub(r"(?:\^|\*\*)(?:\{(?P<braces>[^{}]*)\}|(?P<part>-?\w+|\(-?\d+/\d+\)))", _sup, words)
    words = re.sub(rf"(?<![A-Za-ce-z_&])(?:{LETTER})(?![A-Za-z_]|-[a-z])", lambda m: GREEK[m[0]], words)
    words = re.sub(r"(?<![\w*])\*(?=\w)|(?<=\d)\*(?=[A-Za-z(])|(?<=\))\*(?=[\w(])", "·", words)
    return re.sub(r"(?<![\w).-])-(?=[\d.]*\d)|(?<=[\s(\[])-(?=[\s\wα-ωΨ(])", "−", words)


def _sub(found: re.Match[str]) -> str:
    return f"{'Σ' if found[1] == 'sum' else found[1]}<sub>{found[2]}</sub>"

"""Text, numbers and names as LaTeX that any engine reads: nothing outside ASCII is left."""

import re

from rkverify.errors import BadInput

SPECIAL = {
    **{c: f"\\{c}" for c in "#$%&_{}"},
    "\\": "\\textbackslash{}",
    "~": "\\textasciitilde{}",
    "^": "\\textasciicircum{}",
    "<": "\\ensuremath{<}",
    ">": "\\ensuremath{>}",
    "|": "\\ensuremath{|}",
}
SIGNS = {
    **{c: f"\\ensuremath{{\\{name}}}" for c, name in {
        "α": "alpha", "β": "beta", "γ": "gamma", "δ": "delta", "ε": "varepsilon", "θ": "theta", "λ": "lambda", "μ": "mu",
        "ν": "nu", "π": "pi", "ρ": "rho", "σ": "sigma", "τ": "tau", "φ": "phi", "ψ": "psi", "ω": "omega", "Γ": "Gamma",
        "Δ": "Delta", "Σ": "Sigma", "Φ": "Phi", "Ψ": "Psi", "Ω": "Omega", "±": "pm", "≤": "leq", "≥": "geq", "×": "times",
        "·": "cdot", "→": "rightarrow", "∞": "infty", "≈": "approx", "≠": "neq", "√": "surd",
    }.items()},
    "−": "\\ensuremath{-}", "²": "\\ensuremath{^2}", "³": "\\ensuremath{^3}", "₀": "\\ensuremath{_0}", "…": "\\ldots{}",
    "–": "--", "—": "---", "’": "'", "“": "``", "”": "''", "é": "\\'e", "ã": "\\~a", "ö": '\\"o', "ü": '\\"u',
}  # fmt: skip
DECIMAL = re.compile(r"([+-]?)(\d+(?:\.\d*)?|\.\d+)(?:[eE]([+-]?\d+))?")
ONES = [
    "zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve", "thirteen",
    "fourteen", "fifteen", "sixteen", "seventeen", "eighteen", "nineteen",
]  # fmt: skip
TENS = ["zero", "ten", "twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety"]


def text(words: str) -> str:
    r"""Words for LaTeX.

    Raises BadInput for a character that it has no way to write.

    >>> text("50% of σ_max < 1")
    '50\\% of \\ensuremath{\\sigma}\\_max \\ensuremath{<} 1'
    """
    written = []
    for character in words:
        known = SPECIAL.get(character) or SIGNS.get(character)
        if known is None and not character.isascii():
            raise BadInput(
                f"there is no LaTeX for {character!r} in {words[:60]!r}: add it to rkverify/report/latex_text.py"
            )
        written.append(known or character)
    return "".join(written)


def cell(value: str) -> str:
    r"""What a CSV file has in a cell: decimals and fractions as numbers, anything else as text.

    >>> cell("-1.5e-07"), cell("-3/4"), cell("full, R = 3/2")
    ('$-1.5\\times 10^{-7}$', '$-3/4$', 'full, R = 3/2')
    """
    found = DECIMAL.fullmatch(value)
    if found:
        sign, digits, power = found.groups()
        times = f"\\times 10^{{{int(power)}}}" if power else ""
        return f"${sign}{digits}{times}$"
    if re.fullmatch(r"-?\d+/\d+", value):
        return f"${value}$"
    return text(value)


def number_word(number: int) -> str:
    """A whole number from 0 in letters, as the name of a macro needs it; beyond 99 digit by digit.

    >>> number_word(7), number_word(43), number_word(120)
    ('seven', 'fortythree', 'onetwozero')
    """
    if number < 20:
        return ONES[number]
    if number < 100:
        tens, ones = divmod(number, 10)
        return TENS[tens] + (ONES[ones] if ones else "")
    return "".join(ONES[int(digit)] for digit in str(number))


def name(*parts: str) -> str:
    r"""The name of a macro: rkv, and the words of all parts, each with a capital, numbers in letters.

    >>> name("C43", "State"), name("closed_forms", "dni, full derivative")
    ('rkvCfortythreeState', 'rkvClosedFormsDniFullDerivative')
    """
    words = []
    for part in parts:
        for word in re.findall(r"[A-Za-z]+\d*|\d+", part):
            letters, digits = re.fullmatch(r"([A-Za-z]*)(\d*)", word).groups()  # type: ignore[union-attr]
            spoken = number_word(int(digits)) if digits else ""
            words.append((letters[:1].upper() + letters[1:] + spoken) if letters else spoken.capitalize())
    return "rkv" + "".join(words)

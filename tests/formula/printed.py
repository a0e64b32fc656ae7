"""Formulas of the pages, evaluated as they are printed: LaTeX or plain text becomes Python."""
import re

import numpy as np
from scipy import special

PLAIN = {"abs": abs, "sqrt": np.sqrt, "ln": np.log, "exp": np.exp, "atan": np.arctan, "acosh": np.arccosh,
         "cosh": np.cosh, "sinh": np.sinh, "asin": np.arcsin, "pi": np.pi, "atanh": np.arctanh,
         "atan2": np.arctan2, "sgn": np.sign, "Re": np.real, "Im": np.imag, "max": max, "E_1": special.exp1,
         "Ei": special.expi, "K_0": special.k0, "K_1": special.k1}
used = {}  # page: what has been evaluated


def squeezed(text):
    return " ".join(text.split())


def printed(page, text):
    """The text, which must stand on the page."""
    with open(f"docs/{page}") as file:
        assert squeezed(text) in squeezed(file.read()), f"docs/{page}: the page does not have {text!r}"
    used.setdefault(page, []).append(squeezed(text))
    return text


def plain(text):
    """LaTeX as plain text."""
    for old, new in [(r"\\left|\\right|\\,|\\;|\\!|\\quad|&", " "), (r"\\tfrac(\d)(\d)", r"(\1/\2)"),
                     (r"\\operatorname\{(\w+)\}|\\mathrm\{(\w+)\}", r" \1\2 "), (r"E\^\*|E\\\*", " Es "), (r"\\hat ", " "),
                     (r"\\([A-Za-z]+)", r" \1 "), (r" cdot ", "*")]:
        text = re.sub(old, new, text)
    group = r"\{((?:[^{}]|\{[^{}]*\})*)\}"
    while re.search(r"t?frac\s*" + group, text):
        text = re.sub(r"t?frac\s*" + group + r"\s*" + group, r"((\1)/(\2))", text)
    text = re.sub(r"_\{(\w+)\}", r"_\1", text)
    return re.sub(r"\|([^|]*)\|", r"abs(\1)", text.replace("{", "(").replace("}", ")")).replace("[", "(").replace("]", ")")


def value(text, **names):
    """A formula with the numbers of its letters; what stands side by side is multiplied."""
    known = {**PLAIN, **names}
    tokens, result = re.findall(r"\d+\.?\d*(?:e-?\d+)?|[A-Za-z]\w*'*|\S", plain(text)), []
    words = []
    for token in tokens:  # 2aX: the longest names that are known
        while re.match(r"[A-Za-z]", token) and token not in known:
            cut = max((k for k in range(1, len(token)) if token[:k] in known), default=0)
            assert cut, f"{token!r} of {text!r} is not known"
            words.append(token[:cut])
            token = token[cut:]
        words.append(token)
    for word in words:
        last = result[-1] if result else "("
        operand = re.match(r"[\w.]", word[0]) or word == "("
        if operand and (re.match(r"[\w.']", last[-1]) or last == ")") and not callable(known.get(last)):
            result.append("*")
        result.append("**" if word == "^" else word)
    source, k = "", 0
    while k < len(result):  # ln x, sinh x: up to the next sum
        source += result[k]
        if callable(known.get(result[k])) and k + 1 < len(result) and result[k + 1] != "(":
            end = k + 1
            while end < len(result) and result[end] not in "+-),":
                end += 1
            source += "(" + "".join(result[k + 1:end]) + ")"
            k = end - 1
        k += 1
    return eval(source, {"__builtins__": {}}, known)


def close(got, wanted, bound=1e-9):
    got, wanted = np.asarray(got), np.asarray(wanted)
    error = abs(got - wanted).max()/max(abs(wanted).max(), 1e-300)
    assert error <= bound, f"{got} is not {wanted}: off by {error:.1e}"


def run(chapter):
    """Every function of a chapter that is named after its tag: 0, or how many do not hold."""
    failed = 0
    for name, check in list(chapter.items()):
        if callable(check) and re.match(r"tag_", name):
            try:
                check()
                print(f"[       OK ] {name}")
            except Exception as error:
                failed += 1
                print(f"{name}: {error!r}\n[  FAILED  ] {name}")
    return failed

"""Holds the figures of the pages to what they come from.

`pages/NAME.toml` has, for a page, claims: pieces of its text, each with where its figures come from, which is one of

- `measured = "NAME"`: `values/NAME.toml`, written by `measure.py NAME`. `{key}` in the text stands for a value;
- `computed = { key = "formula" }`: a formula of Python's `math`, for what follows from a closed form or from stored values,
  `of("NAME")`;
- `source = "path/of/a/file"`, or a list of them: each number must be in one of these files, as it stands or in SI units, `3 %`
  as 0.03.
  Behind `::` stands a function of a Rust file, or `blocks` for what a page shows in blocks of code;
- `given = "reason"`: no figure of ours (a paper's, a year, the number of an equation), or one that nothing here can check.

Slots have Python's formats (`{x:.3f}`), or `{x:r2}`: two digits that count, with commas. A value with its error, two numbers in
a list, becomes `a ± b`; `{x:.4g±.2g}` has a format for each. Each text must stand on its page exactly once, however its lines
are broken, and has the sign and the unit of each of its numbers. Where a page has `covers = "all"`, each of its numbers outside
of blocks of code must be in a text.
"""

import difflib
import functools
import math
import re
import tomllib
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]

NUMBER = re.compile(r"(?<![\w.,])(?<![A-Za-z]-)(?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d+)?(?:e[-+]?\d+)?(?![\d])")
SIGNS = "-+±<>≤≥≈"
UNIT = re.compile(r"\s?(?:%|°|(?:[kMGTµunmp]?(?:m|s|J|N|Pa|Hz|W|B|K|kg|g|eV)(?:/\S+)?|million|billion)(?![\w`]))")
SCALES = {"%": 1e-2, "µ": 1e-6, "u": 1e-6, "n": 1e-9, "p": 1e-12, "m": 1e-3, "c": 1e-2, "k": 1e3, "M": 1e6, "G": 1e9}
PAGES = {str(path.relative_to(HERE / "pages").with_suffix("")): path for path in sorted((HERE / "pages").rglob("*.toml"))}
KINDS = ("measured", "computed", "source", "given")


@dataclass
class Claim:
    """A piece of a page's text, filled in, and where its figures come from."""

    text: str
    kind: str
    origin: object

    @property
    def pattern(self):
        words = [re.escape(word) for word in self.text.split()]
        return re.compile(r"(?<![\w.,])" * self.text[0].isdigit() + r"\s+".join(words) + r"(?!\d|[.,]\d)")

    @property
    def why(self):
        return {
            "measured": f"the stored measurement docs/measured/values/{self.origin}.toml",
            "computed": "the formulas beside it",
            "source": f"{self.origin}",
            "given": f"the note: {self.origin}",
        }[self.kind]


def page_path(name):
    """Where a page is: at the top or in docs/."""
    top = ROOT / f"{name}.md"
    return top if name.isupper() else ROOT / "docs" / f"{name}.md"


def blank(found):
    return re.sub(r"\S", " ", found[0])


@functools.cache
def page_text(name):
    """The page with blocks of code, targets of links, comments and tables that the program makes blanked out."""
    text = page_path(name).read_text()
    text = re.sub(r"^<!-- made: .*?^<!-- end -->", blank, text, flags=re.DOTALL | re.MULTILINE)
    text = re.sub(r"^```.*?^```", blank, text, flags=re.DOTALL | re.MULTILINE)
    return re.sub(r"(?<=\])\([^)\s]*\)|<!--.*?-->", blank, text, flags=re.DOTALL)


class Value:
    """A value with the formats of pages."""

    def __init__(self, value):
        self.value = value

    def __getitem__(self, key):
        return Value(self.value[key])

    def __format__(self, spec):
        value = self.value
        if isinstance(value, list):
            first, _, second = spec.partition("±")
            return f"{Value(value[0]):{first}} ± {Value(value[1]):{second or first}}"
        if spec.startswith("r"):
            digits = int(spec[1:]) - 1 - math.floor(math.log10(abs(value)))
            text = f"{round(value, digits):,.{max(digits, 0)}f}"
        else:
            text = format(value, spec)
        return re.sub(r"e([-+])0*(\d)", lambda found: "e" + found[1].strip("+") + found[2], text)


@functools.cache
def values_of(name):
    """The stored values of a measurement."""
    return tomllib.loads((HERE / f"values/{name}.toml").read_text())["values"]


def claims(name):
    """The claims about a page, in the order of its file."""
    for entry in tomllib.loads(PAGES[name].read_text()).get("claims", []):
        kind = next(kind for kind in KINDS if kind in entry)
        slots = {}
        if kind == "measured":
            slots = {key: Value(value) for key, value in values_of(entry[kind]).items()}
        elif kind == "computed":
            slots = {key: Value(eval(formula, {**vars(math), "of": values_of})) for key, formula in entry[kind].items()}
        for text in entry["says"]:
            yield Claim(text.format(**slots) if slots else text, kind, entry[kind])


def covers_all(name):
    return tomllib.loads(PAGES[name].read_text()).get("covers") == "all"


def line_of(text, at):
    return text.count("\n", 0, at) + 1


def nearest(text, claim):
    """What stands on the page in the place of a text: the piece of as many words that is most like it, and where."""
    words = list(re.finditer(r"\S+", text))
    wanted = claim.text.split()
    count, best, ratio_of_best = len(wanted), (0, "", 0), 0.0
    known = set(wanted)
    for at in range(max(len(words) - count + 1, 1)):
        piece = [word[0] for word in words[at : at + count]]
        if len(known & set(piece)) * 2 < ratio_of_best * len(known):
            continue
        ratio = difflib.SequenceMatcher(None, " ".join(piece), " ".join(wanted), autojunk=False).ratio()
        if ratio > ratio_of_best:
            ratio_of_best, best = ratio, (words[at].start(), " ".join(piece), words[at + len(piece) - 1].end())
    return best


def cut_off(text, span, number):
    """The sign or unit of a number that its claim leaves out; nothing if it has both."""
    before, after = text[: number.start()].rstrip(" "), text[number.end() :]
    if before and before[-1] in SIGNS and number.start() == span[0]:
        return before[-1]
    unit = UNIT.match(after)
    if unit and number.end() + unit.end() > span[1]:
        return unit[0].strip()
    return None


def check(name):
    """What is wrong with the figures of a page, a message for each."""
    text, found, spans = page_text(name), [], []
    path, file = page_path(name).relative_to(ROOT), PAGES[name].relative_to(ROOT)
    for claim in claims(name):
        places = [match.span() for match in claim.pattern.finditer(text)]
        if len(places) == 1:
            spans.append(places[0])
        elif places:
            spans += places
            lines = ", ".join(str(line_of(text, start)) for start, _ in places)
            found.append(f"{path}: {claim.text!r} stands in lines {lines}: give {file} more of the words around it")
        else:
            at, piece, end = nearest(text, claim)
            spans.append((at, end))
            found.append(
                f"{path}:{line_of(text, at)}: the page says\n    {piece!r}\n  but by {claim.why} it is\n    {claim.text!r}\n"
                f"  {advice(claim, file)}"
            )
    numbers = list(NUMBER.finditer(text))
    for number in numbers:
        around = [span for span in spans if span[0] <= number.start() and number.end() <= span[1]]
        left_out = [cut_off(text, span, number) for span in around]
        if around and all(left_out):
            found.append(f"{path}:{line_of(text, number.start())}: {file} has {number[0]!r} without its {left_out[0]!r}: write that too")
        if not around and covers_all(name):
            found.append(
                f"{path}:{line_of(text, number.start())}: nothing says where {number[0]!r} in\n    {suggest(text, number)!r}\n"
                f"  comes from. Put these words into {file}, below what they come from (docs/measured/figures.py says how)"
            )
    return found


def advice(claim, file):
    if claim.kind == "measured":
        return f"Put the page right, or run `python3 docs/measured/measure.py {claim.origin}` if the program gives something else now"
    return f"Put the page right; if what the figure comes from has changed, {file} as well"


def suggest(text, number):
    """Words around a number that stand on the page once: a short cell of a table, or a few words."""
    start, end = text.rfind("\n", 0, number.start()) + 1, text.find("\n", number.end())
    end = len(text) if end < 0 else end
    if text[start] == "|":
        bars = [start + found.start() for found in re.finditer(r"(?<!\\)\|", text[start:end])]
        left = max(at for at in bars if at < number.start())
        right = min(at for at in bars if at >= number.end())
        piece = text[left + 1 : right].strip()
        while not is_once(text, piece) and (left > start or right < bars[-1]):
            left = max((at for at in bars if at < left), default=left)
            right = right if left > start else min((at for at in bars if at > right), default=right)
            piece = text[left + 1 : right].strip()
        if len(piece) < 80 and is_once(text, piece):
            return piece
    words = list(re.finditer(r"\S+", text))
    at = next(place for place, word in enumerate(words) if word.end() > number.start())
    for reach in range(2, 12):
        near = words[max(at - reach, 0) : at + reach + 1]
        piece = " ".join(word[0] for word in near)
        if is_once(text, piece):
            return piece
    return text[start:end].strip()


def is_once(text, piece):
    return len(Claim(piece, "given", "").pattern.findall(text)) == 1


@functools.cache
def numbers_of(source):
    """All numbers in a file, in one function of a Rust file, or in the blocks of code of a page."""
    path, _, name = source.partition("::")
    text = (ROOT / path).read_text()
    if name == "blocks":
        text = "".join(re.findall(r"^```.*?^```", text, re.DOTALL | re.MULTILINE))
    elif name:
        found = re.search(rf"^( *)(?:pub )?fn {name}\b.*?^\1\}}", text, re.DOTALL | re.MULTILINE)
        assert found, f"{path} has no function {name}"
        text = found[0]
    text = re.sub(r"(?<=\d)_(?=\d)|(?<=\d),(?=\d{3})", "", text)
    return [float(number) for number in re.findall(r"(?<![\w.])\d+\.?\d*(?:e[-+]?\d+)?", text.replace("_f64", ""))]


def in_source(number, after, sources):
    """Whether a number of a page is one of a source, as it stands or in SI units."""
    value = float(number.replace(",", ""))
    unit = re.match(r"[\s)]*([%µunpmckMG])", after)
    wanted = {value, value * SCALES[unit[1]]} if unit else {value}
    if unit and unit[1] == "%":
        # Code has no percentages.
        wanted = {value / 100}
    return any(math.isclose(known, want, rel_tol=1e-9) for source in sources for known in numbers_of(source) for want in wanted)


def check_sources(name):
    """Claims whose numbers are in none of their sources."""
    found, path = [], page_path(name).relative_to(ROOT)
    for claim in claims(name):
        if claim.kind != "source":
            continue
        sources = [claim.origin] if isinstance(claim.origin, str) else claim.origin
        for number in NUMBER.finditer(claim.text):
            if not in_source(number[0], claim.text[number.end() :], sources):
                found.append(
                    f"{path}: it says {claim.text!r}, but {number[0]} is no longer in {', '.join(sources)}: what the page says must "
                    f"be what is there; put page and {PAGES[name].relative_to(ROOT)} right"
                )
    return found

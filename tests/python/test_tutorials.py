"""The tutorials do what they say.

Every ```console block of docs/tutorials/*.md is run, page by page, in an empty folder. A line that begins with `$ ` is a
command; the lines below it are what it must print, all of it:

- `...` on a line of its own stands for any lines, within a line for any characters;
- below `<!-- varies: NAME; NAME -->` any other numbers may stand in lines that begin with such a name: clocks, threads, memory;
- below `<!-- within 20 %: NAME; NAME -->` numbers in such lines may differ by so much: where collisions scatter what processors
  round otherwise; in rows of a table `column NAME` is a name; a name that no line has is refused;
- progress, which a run tells every ten seconds where there is no terminal, is not looked at;
- below `<!-- exit 2 -->` the commands must end with this code instead of 0;
- below `<!-- file: NAME -->` the next block is a file and is written under this name.

AGGLO names another program than target/debug/agglo.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGES = sorted((ROOT / "docs/tutorials").glob("*.md"))
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
# Of times and sizes, which change where numbers may.
UNIT = r"(?: (?:us|ms|s|min|h|B|kB|MB|GB)\b)"
PROGRESS = re.compile(r" *\d+ %  .* left(?:, .*)?")
RULE = re.compile(r"(?:varies|within (\d+) %): (.*)")
BLOCK = re.compile(r"((?:<!--.*?-->\n)*)```(\w*)\n(.*?)^```$", re.DOTALL | re.MULTILINE)


@pytest.fixture(scope="module")
def program(request):
    """The program under test, built if none is named."""
    named = os.environ.get("AGGLO")
    return Path(named) if named else request.getfixturevalue("built") / "agglo"


def blocks(text):
    """All blocks of a page: the remarks before each, its language and what it holds."""
    for remarks, language, content in BLOCK.findall(text):
        yield re.findall(r"<!-- *(.*?) *-->", remarks), language, content


def commands(content):
    """The commands of a console block, each with the lines that it must print."""
    for part in re.split(r"^\$ ", content, flags=re.MULTILINE)[1:]:
        lines = part.rstrip("\n").split("\n")
        command = lines.pop(0)
        while command.endswith("\\"):
            command = f"{command}\n{lines.pop(0)}"
        yield command, lines


class Rules:
    """Which numbers of a block need not be those of the page, by the names in its remarks."""

    def __init__(self, remarks):
        found = [RULE.fullmatch(remark) for remark in remarks]
        self.freedoms = {
            name.strip(): float(rule[1]) / 100 if rule[1] else float("inf")
            for rule in found
            if rule
            for name in rule[2].split(";")
        }
        self.used = set()

    def of(self, name):
        """How far numbers may be off under a name; nothing if they may not."""
        if name in self.freedoms:
            self.used.add(name)
        return self.freedoms.get(name)

    def of_line(self, line):
        names = [name for name in self.freedoms if line.strip().startswith(name)]
        return self.of(max(names, key=len)) if names else None

    def assert_all_used(self):
        unused = set(self.freedoms) - self.used
        assert not unused, f"no line begins with {', '.join(sorted(unused))}"


def pieces(line, columns, rules):
    """A line cut up: texts, each with how far numbers in it may be off."""
    cells = line.split(",")
    if columns and len(cells) == len(columns):
        for at, (cell, column) in enumerate(zip(cells, columns)):
            yield ("," if at else "") + cell, rules.of(f"column {column}")
    else:
        yield line, rules.of_line(line)


def pattern(lines, rules):
    """What the printed text must look like, and the numbers in its groups with how far they may be off."""
    parts, wanted, columns = [], [], []
    for line in lines:
        if line.strip() == "...":
            parts.append(r"(?:.*\n)*?")
            continue
        cells = line.split(",")
        if len(cells) > 1 and all(re.fullmatch(r"[a-z]\w*", cell) for cell in cells):
            columns = cells
        part = ""
        for text, freedom in pieces(line.rstrip(), columns, rules):
            for at, between in enumerate(text.split("...")):
                part += ".*" if at else ""
                if freedom is not None:
                    wanted += [(float(number), freedom) for number in NUMBER.findall(between)]
                    if freedom == float("inf"):
                        between = re.sub(NUMBER.pattern + UNIT, "\1", between)
                    between = NUMBER.sub("\0", between)
                escaped = re.escape(between).replace("\0", f"({NUMBER.pattern})")
                escaped = escaped.replace("\1", f"({NUMBER.pattern}){UNIT}")
                # Columns are as wide as their numbers.
                part += re.sub(r"(?:\\ ){2,}", " +", escaped)
        parts.append(part + r" *\n")
    return re.compile("".join(parts)), wanted


def difference(lines, rules, printed):
    """What is wrong with the printed text; nothing if it is what the page shows."""
    shape, wanted = pattern(lines, rules)
    found = shape.fullmatch(printed)
    if not found:
        return "the lines are others"
    for (number, freedom), text in zip(wanted, found.groups()):
        if abs(float(text) - number) > freedom * abs(number):
            return f"{text} is printed where the page has {number:g}, and {100 * freedom:g} % are allowed"
    return None


def environment(program):
    """Where the tutorials' commands are found: this agglo, this Python."""
    path = os.pathsep.join([str(program.parent), str(Path(sys.executable).parent), os.environ["PATH"]])
    return {**os.environ, "PATH": path, "COLUMNS": "120", "NO_COLOR": "1"}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_tutorial_does_what_it_says(page, program, tmp_path):
    ran = 0
    for remarks, language, content in blocks(page.read_text()):
        for remark in remarks:
            if remark.startswith("file: "):
                (tmp_path / remark.removeprefix("file: ")).write_text(content)
        if language != "console":
            continue
        rules = Rules(remarks)
        wanted = next((int(remark.split()[1]) for remark in remarks if remark.startswith("exit ")), 0)
        for command, lines in commands(content):
            done = subprocess.run(
                ["bash", "-c", command],
                cwd=tmp_path,
                env=environment(program),
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
                timeout=300,
                check=False,
            )
            assert done.returncode == wanted, f"{page.name}: {command}\n{done.stdout}"
            if lines:
                told = [line.rstrip() for line in done.stdout.splitlines()]
                printed = "".join(f"{line}\n" for line in told if not PROGRESS.fullmatch(line))
                wrong = difference(lines, rules, printed)
                page_says = "\n".join(lines)
                assert not wrong, f"{page.name}: {wrong}; {command} printed\n{printed}\nand not\n{page_says}"
            ran += 1
        rules.assert_all_used()
    assert ran > 0, f"{page.name} runs nothing"


def test_there_are_tutorials():
    assert len(PAGES) >= 6


def test_the_check_itself_can_fail():
    def same(lines, printed, *remarks):
        return difference(lines, Rules(remarks), printed) is None

    assert same(["a  1.5 s", "...", "end"], "a   22.75 s\nx\ny\nend\n", "varies: a")
    assert not same(["a 1.5 s"], "a 1.6 s\n")
    assert not same(["a 1.5 s"], "a 1.6 s\n", "varies: b")
    assert same(["a 1.5 s of x"], "a 16 ms of x\n", "varies: a") and not same(["a 1.5 s"], "a 1.6 ms\n", "within 9 %: a")
    assert not same(["a 1.5 s"], "a s\n", "varies: a")
    assert same(["a 1.5 s"], "a 1.6 s\n", "within 10 %: a") and not same(["a 1.5 s"], "a 1.7 s\n", "within 10 %: a")
    assert not same(["a", "b"], "a\nc\nb\n")
    rows = ["x_m,y_m", "1,2", "3,4"]
    assert same(rows, "x_m,y_m\n1,2.1\n3,4.3\n", "within 10 %: column y_m")
    assert not same(rows, "x_m,y_m\n1.01,2.1\n3,4.3\n", "within 10 %: column y_m")
    assert not same(rows, "x_m,y_m\n1,2\n3,5\n", "within 10 %: column y_m")
    assert not same(rows, "x_m,z_m\n1,2\n3,4\n", "varies: column y_m")
    with pytest.raises(AssertionError):
        Rules(["varies: nothing"]).assert_all_used()
    assert same(["in ... folder"], "in out/a folder\n")
    assert list(commands("$ one\nsaid\n$ two \\\n  more\n")) == [("one", ["said"]), ("two \\\n  more", [])]
    found = list(blocks("<!-- file: a.toml -->\n```toml\nx = 1\n```\n\n<!-- exit 2 -->\n```console\n$ no\n```\n"))
    assert found == [(["file: a.toml"], "toml", "x = 1\n"), (["exit 2"], "console", "$ no\n")]

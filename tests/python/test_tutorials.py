"""The tutorials do what they say.

Every ```console block of docs/tutorials/*.md is run, page by page, in an empty folder. A line that begins with `$ ` is a
command; the lines below it are what it must print, all of it:

- `...` on a line of its own stands for any lines, within a line for any characters;
- below `<!-- numbers vary -->` every number stands for any other, since clocks and processors differ;
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
NUMBER = re.compile(r"[-+]?\d[\d.,:]*(?:e[-+]?\d+)?")
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


def pattern(lines, numbers_vary):
    """What the printed text must look like."""
    parts = []
    for line in lines:
        if line.strip() == "...":
            parts.append(r"(?:.*\n)*?")
            continue
        pieces = line.rstrip().split("...")
        if numbers_vary:
            pieces = [NUMBER.sub("\0", piece) for piece in pieces]
        escaped = [re.escape(piece).replace("\0", NUMBER.pattern) for piece in pieces]
        # Columns are as wide as their numbers.
        escaped = [re.sub(r"(?:\\ ){2,}", " +", piece) for piece in escaped]
        parts.append(".*".join(escaped) + r" *\n")
    return re.compile("".join(parts))


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
                printed = "".join(f"{line.rstrip()}\n" for line in done.stdout.splitlines())
                shown = pattern(lines, "numbers vary" in remarks)
                assert shown.fullmatch(printed), f"{page.name}: {command} printed\n{printed}\nand not\n" + "\n".join(lines)
            ran += 1
    assert ran > 0, f"{page.name} runs nothing"


def test_there_are_tutorials():
    assert len(PAGES) >= 6


def test_the_check_itself_can_fail():
    assert pattern(["a  1.5 s", "...", "end"], True).fullmatch("a   22.75 s\nx\ny\nend\n")
    assert not pattern(["a 1.5 s"], False).fullmatch("a 1.6 s\n")
    assert not pattern(["a 1.5 s"], True).fullmatch("a s\n")
    assert not pattern(["a", "b"], False).fullmatch("a\nc\nb\n")
    assert pattern(["in ... folder"], False).fullmatch("in out/a folder\n")
    assert list(commands("$ one\nsaid\n$ two \\\n  more\n")) == [("one", ["said"]), ("two \\\n  more", [])]
    found = list(blocks("<!-- file: a.toml -->\n```toml\nx = 1\n```\n\n<!-- exit 2 -->\n```console\n$ no\n```\n"))
    assert found == [(["file: a.toml"], "toml", "x = 1\n"), (["exit 2"], "console", "$ no\n")]


def test_the_page_of_all_laws_is_what_the_program_lists(program):
    listed = subprocess.run([program, "list-laws", "--markdown"], capture_output=True, text=True, check=True).stdout
    page = (ROOT / "docs/laws.md").read_text()
    assert listed.strip() in page, "docs/laws.md is not what `agglo list-laws --markdown` prints: put it right"

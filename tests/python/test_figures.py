"""Every figure of the pages is a stored measurement, a closed form, a number of the code, or noted as none of ours.

`docs/measured/figures.py` says how that is written down, `docs/measured/measure.py` measures again. What takes some seconds is
measured here each time; AGGLO names another program than target/debug/agglo.
"""

import json
import os
import platform
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "docs/measured"))

import figures  # noqa: E402
import measure  # noqa: E402
from test_defaults import SCENARIO  # noqa: E402

WANTED = {
    "README", "CHANGELOG", "cluster", "convergence", "differences", "embedding", "files", "gallery", "performance", "pictures", "report", "search",
    "validation", "validity", "watch", *(f"tutorials/{path.stem}" for path in (ROOT / "docs/tutorials").glob("*.md")),
}  # fmt: skip


@pytest.mark.parametrize("page", sorted(figures.PAGES))
def test_every_figure_of_a_page_comes_from_somewhere(page):
    wrong = figures.check(page) + figures.check_sources(page)
    assert not wrong, "\n\n".join(wrong)


def test_pages_with_figures_are_checked():
    assert set(figures.PAGES) == WANTED
    assert {page for page in WANTED if not figures.covers_all(page)} == {"CHANGELOG"}


@pytest.mark.parametrize("name", sorted(measure.MEASUREMENTS))
def test_a_stored_measurement_is_of_its_command(name):
    assert measure.stored(name)["command"] == measure.MEASUREMENTS[name][0], f"run docs/measured/measure.py {name}"


@pytest.mark.parametrize("name", measure.QUICK)
def test_a_stored_measurement_is_what_the_program_gives(name, request, monkeypatch):
    monkeypatch.setenv("AGGLO", os.environ.get("AGGLO") or str(request.getfixturevalue("built") / "agglo"))
    stored = measure.stored(name)
    known, now = stored["values"], measure.MEASUREMENTS[name][1]()
    # Collisions scatter what other processors round otherwise.
    near = 1e-6 if stored["machine"].startswith(platform.machine()) else 0.2
    wrong = [f"{key}: stored {known.get(key)}, now {value}" for key, value in now.items() if known.get(key) != pytest.approx(value, rel=near)]
    assert not wrong and set(known) == set(now), (
        f"{measure.MEASUREMENTS[name][0]} gives other figures than docs/measured/values/{name}.toml:\n" + "\n".join(wrong)
        + f"\nIf that is meant, run `python3 docs/measured/measure.py {name}`, and put the pages right that this test names then"
    )  # fmt: skip


def test_validation_names_tests_that_exist():
    """Names in back quotes in the first column of a table of cases; `...` stands for the rest of one."""
    code = "\n".join(path.read_text() for path in sorted((ROOT / "crates").rglob("*.rs")))
    functions = set(re.findall(r"\bfn (\w+)", code))
    count = 0
    for line in (ROOT / "docs/validation.md").read_text().splitlines():
        if not line.startswith("| `"):
            continue
        for name in re.findall(r"`([\w.:]+)`", line.split(" | ")[0]):
            last = name.split("::")[-1]
            if len(last) < 16 or "_" not in last:
                continue
            pattern = re.compile(r"(?:val_)?" + re.escape(last).replace(r"\.\.\.", r"\w*"))
            assert any(pattern.fullmatch(function) for function in functions), f"docs/validation.md: there is no test {name}"
            count += 1
    assert count > 60, f"{count} names of tests were found"


PAGE = """The run takes 12 s, or -3 % less
than before (Author 2001). | 4 | 5 kg |
```sh
run 77
```
"""
CLAIMS = """covers = "all"
[[claims]]
measured = "one"
says = ["takes {time} s", "or {less:.0f} % less than"]
[[claims]]
computed = { four = "sqrt(16)", mass = "of('one')['mass'] / 1000" }
says = ["| {four:.0f} | {mass:.0f} kg |"]
[[claims]]
given = "a year"
says = ["(Author 2001)"]
"""


@pytest.fixture
def checked(monkeypatch, tmp_path):
    """What is said of a page of this text with these claims."""

    def check(page, claims=CLAIMS):
        (tmp_path / "values").mkdir(exist_ok=True)
        (tmp_path / "values/one.toml").write_text("[values]\ntime = 12\nless = -3.2\nmass = 5000\n")
        (tmp_path / "page.toml").write_text(claims)
        (tmp_path / "page.md").write_text(page)
        monkeypatch.setattr(figures, "HERE", tmp_path)
        monkeypatch.setattr(figures, "ROOT", tmp_path)
        monkeypatch.setattr(figures, "page_path", lambda _: tmp_path / "page.md")
        monkeypatch.setitem(figures.PAGES, "page", tmp_path / "page.toml")
        figures.page_text.cache_clear()
        figures.values_of.cache_clear()
        return "\n".join(figures.check("page") + figures.check_sources("page"))

    yield check
    figures.page_text.cache_clear()
    figures.values_of.cache_clear()
    figures.numbers_of.cache_clear()


def test_the_check_itself_can_fail(checked):
    assert not checked(PAGE)
    for right, wrong in [("12 s", "13 s"), ("12 s", "12 ms"), ("-3 %", "3 %"), ("-3 %", "-3"), ("| 4", "| 6"), ("2001", "2011"), ("5 kg", "5 g")]:
        said = checked(PAGE.replace(right, wrong))
        assert "page.md:" in said and "it is" in said, f"{right} -> {wrong}: {said}"
    said = checked(PAGE.replace("12 s", "13 s"))
    assert "page.md:1" in said and "'takes 13 s,'" in said and "'takes 12 s'" in said and "measure.py one" in said, said
    assert "nothing says where '9'" in checked(PAGE + "and 9 more\n")
    assert "without its '%'" in checked(PAGE, CLAIMS.replace("{less:.0f} % less than", "{less:.0f}"))
    assert "stands in lines" in checked(PAGE + "takes 12 s\n")


def test_a_source_must_have_the_number(checked, tmp_path):
    (tmp_path / "law.rs").write_text("fn one() {\n    assert!(off < 0.003 && many == 1_234);\n}\nfn two() {\n    let x = 7e-6;\n}\n")
    claims = CLAIMS + '[[claims]]\nsource = "law.rs::one"\nsays = ["within 0.3 % of 1,234"]\n[[claims]]\nsource = "law.rs"\nsays = ["7 µm off"]\n'
    page = PAGE + "within 0.3 % of 1,234, 7 µm off\n"
    assert not checked(page, claims)
    said = checked(page.replace("7 µm", "8 µm"), claims.replace("7 µm", "8 µm"))
    assert "8 is no longer in law.rs" in said, said
    assert "0.4 is no longer" in checked(page.replace("0.3 %", "0.4 %"), claims.replace("0.3 %", "0.4 %"))
    assert "7 is no longer in law.rs::one" in checked(page, claims.replace('"law.rs"', '"law.rs::one"'))


def names_in(text):
    """Names in back quotes, with what lies between `a_x_m` ... `a_z_m`."""
    found = set(re.findall(r"`(\w+)`", text))
    for first, last in re.findall(r"`(\w+)` \.\.\. `(\w+)`", text):
        at = next(place for place, (a, b) in enumerate(zip(first, last)) if a != b)
        found |= {first[:at] + axis + first[at + 1 :] for axis in "xyz"}
    return found


@pytest.mark.parametrize("engine", ["soft", "hard"])
def test_every_column_and_key_of_a_run_is_on_the_page_of_files(engine, built, tmp_path):
    program, file, out = built / "agglo", tmp_path / "my.toml", tmp_path / "out"
    new = subprocess.run([program, "new", "reacting"], check=True, capture_output=True, text=True).stdout
    file.write_text(SCENARIO if engine == "soft" else new)
    command = [program, "run", file, "-o", out, "--no-report", "--set", "time.end=0.5 ms"]
    subprocess.run(command, check=True, capture_output=True)
    page = (ROOT / "docs/files.md").read_text()
    soft, hard = page.split("## Files of hard spheres")
    named = names_in(soft) | (names_in(hard) if engine == "hard" else set())
    # Of momentum the page has the prefixes.
    named |= {prefix + name for prefix in ("drift_", "walls_") for name in names_in(page) if re.match(r"[pl][xyz]_kg", name)}
    wrong = [f"summary.json: {key}" for key in json.loads((out / "summary.json").read_text()) if key not in named]
    tables = sorted(out.rglob("*.csv"))
    for table in tables:
        columns = table.read_text().split("\n", 1)[0].split(",")
        wrong += [f"{table.relative_to(out)}: {column}" for column in columns if column not in named]
    assert not wrong and len(tables) > 5, "docs/files.md does not tell of\n" + "\n".join(wrong)

"""Which licenses come with the crates that agglo is built from: LICENSE-THIRD-PARTY, which goes into the wheel.

`python3 tests/wheel/licenses.py` says whether the file is what Cargo.lock asks for and each license is one that may be passed on
as agglo is; with `--write` it writes the file anew. Needs Python 3.11, cargo, and the sources of all crates (`cargo fetch`).
"""

import json
import re
import subprocess
import sys
import textwrap
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FILE = ROOT / "LICENSE-THIRD-PARTY"

# What lets its code be passed on under MIT or Apache 2.0, if its text goes along.
ALLOWED = {"Apache-2.0", "Apache-2.0 WITH LLVM-exception", "BSD-2-Clause", "MIT", "Unicode-3.0", "Zlib"}

HEAD = """\
Licenses of what agglo is built from

The wheel of agglo for Python, and the program agglo, hold code of these crates (some of them on Windows or macOS alone), under
the licenses that stand beside them. Where Apache-2.0 is one of several to choose from, the crate is used under that one, whose
text is in LICENSE-APACHE; the text of each other license follows. Rust's standard library is under MIT or Apache-2.0 as well.

Made from Cargo.lock by tests/wheel/licenses.py.
"""
# Crates whose packages hold no text.
PLAIN = "Its package holds no text of its license. By its manifest it is by {authors}, under the MIT license:\n\n{text}"


def is_allowed(expression):
    """Whether a license expression can be met by what is allowed: any of those joined by OR, all of those joined by AND."""
    # Old manifests have a slash for OR.
    words = re.findall(r"[()]|\bOR\b|\bAND\b|[^()\s]+(?: WITH \S+)?", expression.replace("/", " OR "))

    def either():
        holds = both()
        while words and words[0] == "OR":
            words.pop(0)
            holds |= both()
        return holds

    def both():
        holds = one()
        while words and words[0] == "AND":
            words.pop(0)
            holds &= one()
        return holds

    def one():
        word = words.pop(0)
        if word != "(":
            return word in ALLOWED
        holds = either()
        words.pop(0)
        return holds

    return either()


class NoSourcesError(Exception):
    """Sources of crates are missing and cannot be fetched."""


def metadata():
    """What cargo says of all crates, also of those that other systems need alone."""
    command = ["cargo", "metadata", "--locked", "--format-version", "1"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    if done.returncode != 0:
        raise NoSourcesError(done.stderr)
    return json.loads(done.stdout)


def faults(data):
    """Crates, those of tests and tools as well, whose license is none that is allowed."""
    return [
        f"{package['name']} {package['version']}: {package['license']}"
        for package in data["packages"]
        if not is_allowed(package["license"] or "none")
    ]


def linked(data):
    """The crates of others whose code is part of the module for Python, in order: not what runs while it is built."""
    packages = {package["id"]: package for package in data["packages"]}
    needed = {node["id"]: node["deps"] for node in data["resolve"]["nodes"]}
    todo = [name for name, package in packages.items() if package["name"] == "agglo-py"]
    found = set()
    while todo:
        name = todo.pop()
        is_macro = any("proc-macro" in target["kind"] for target in packages[name]["targets"])
        if name not in found and not is_macro:
            found.add(name)
            todo += [need["pkg"] for need in needed[name] if any(kind["kind"] is None for kind in need["dep_kinds"])]
    others = (packages[name] for name in found if packages[name]["source"])
    return sorted(others, key=lambda package: (package["name"], package["version"]))


def license_text(package):
    """The text of the license under which a crate is used that does not offer Apache-2.0."""
    folder = Path(package["manifest_path"]).parent
    files = sorted(path for path in folder.iterdir() if re.match("licen[sc]e|copying", path.name, re.IGNORECASE))
    # Several are a choice, and the MIT license is always part of it.
    chosen = [path for path in files if "MIT" in path.name] or files
    if chosen:
        return chosen[0].read_text()
    assert package["license"] == "MIT", f"{package['name']} holds no text of its license, {package['license']}"
    mit = (ROOT / "LICENSE-MIT").read_text().split("\n\n", 2)[2]
    authors = [author.split(" <")[0] for author in package["authors"]]
    return PLAIN.format(authors=", ".join(authors) or "its authors", text=mit)


def notices(package):
    """What a license asks to be passed on besides: files that are called NOTICE."""
    folder = Path(package["manifest_path"]).parent
    return [path.read_text() for path in sorted(folder.iterdir()) if path.name.upper().startswith("NOTICE")]


def embedded(data):
    """What is in the program beside code: a name and the text of its license."""
    crates = {package["name"]: Path(package["manifest_path"]).parent for package in data["packages"]}
    page = (ROOT / "crates/agglo-view/src/report/page/licenses.html").read_text()
    fonts = next(crates["dejavu"].glob("assets/*/LICENSE"))
    return [
        ("DejaVu, the font of pictures", fonts.read_text()),
        ("Plotly.js, which draws the charts of reports", page.split("<pre>")[1].split("</pre>")[0].replace("&amp;", "&")),
    ]


def plain(text):
    return "\n".join(line.rstrip() for line in textwrap.dedent(text).strip().splitlines())


def made(data):
    """The file as it should be."""
    crates = linked(data)
    width = max(len(f"{package['name']} {package['version']}") for package in crates)
    rows = [f"{package['name']} {package['version']}".ljust(width) + f"  {package['license']}" for package in crates]
    whose = {}
    for package in crates:
        named = f"{package['name']} {package['version']}"
        # An expression that asks for more than a choice is not met by Apache-2.0 alone.
        if "AND" in package["license"] or "Apache-2.0" not in re.split(r"[ /()]+", package["license"]):
            whose.setdefault(plain(license_text(package)), []).append(named)
        for notice in notices(package):
            whose.setdefault(plain(notice), []).append(named)
    for name, text in embedded(data):
        whose.setdefault(plain(text), []).append(name)
    line = "\n" + "-" * 100 + "\n"
    parts = [HEAD, "\n".join(rows) + "\n", *(", ".join(names) + "\n\n" + text + "\n" for text, names in whose.items())]
    return line.join(parts)


def main():
    data = metadata()
    wrong = faults(data)
    if wrong:
        sys.exit("error: licenses that are not among those allowed:\n  " + "\n  ".join(wrong))
    text = made(data)
    if "--write" in sys.argv[1:]:
        FILE.write_text(text)
    elif not FILE.is_file() or FILE.read_text() != text:
        sys.exit("error: LICENSE-THIRD-PARTY is not what Cargo.lock asks for; python3 tests/wheel/licenses.py --write")


if __name__ == "__main__":
    main()

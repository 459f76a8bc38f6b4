"""How Sphinx makes a book of the guide. docs/README.md is its first page and says what belongs to it.

The pages stay plain Markdown that any forge shows. So there is no table of contents to keep beside them: each heading
of docs/README.md is a part of the book, and the first link in each row of its table is a page.
"""

import re
import subprocess
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

project = "agglo"
author = "The agglo developers"
project_copyright = author
version = release = tomllib.loads((ROOT / "Cargo.toml").read_text())["workspace"]["package"]["version"]

extensions = ["myst_parser"]
root_doc = "docs/README"
# The whole project is the source, so that links out of docs/ lead somewhere. Only these are pages.
include_patterns = ["docs/**.md", "NOTATION.md", "CHANGELOG.md", "CONTRIBUTING.md", "DESIGN.md"]
exclude_patterns = ["target", "out", ".git", "crates", "**/.venv", "docs/studies/**"]

# Headings can be linked as on a forge.
myst_heading_anchors = 3

html_theme = "furo"
html_title = f"agglo {version}"
html_static_path = ["agglo.css"]
html_css_files = ["agglo.css"]
html_show_sphinx = False
html_copy_source = False
# Excerpts of what a search found would have to be fetched, which browsers forbid to pages that are files.
html_show_search_summary = False
html_theme_options = {
    "light_css_variables": {"font-stack": "system-ui, sans-serif", "font-stack--monospace": "ui-monospace, monospace"},
}


def parts(contents):
    """The parts of the book: each with its heading and the pages of its table."""
    for part in re.split(r"^## ", contents, flags=re.MULTILINE)[1:]:
        heading, _, rest = part.partition("\n")
        yield heading.strip(), re.findall(r"^\| \[[^\]]*\]\(([^)#]+)\.md\)", rest, flags=re.MULTILINE)


def add_contents(_app, page, source):
    """Gives the first page a table of contents for the side bar."""
    if page != root_doc:
        return
    for heading, pages in parts(source[0]):
        if pages:
            listed = "\n".join(f"{page}" for page in pages)
            source[0] += f"\n```{{toctree}}\n:hidden:\n:caption: {heading}\n\n{listed}\n```\n"


def add_law_pages(_app, page, source):
    """Gives the list of all laws their pages, which the program prints as they stand at the heads of the laws' files."""
    if page == "docs/laws":
        command = ["cargo", "run", "--quiet", "--locked", "-p", "agglo-cli", "--", "list-laws", "--pages"]
        source[0] += "\n" + subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout


def lead_to_first_page(app, error):
    """Puts an index.html where one looks for it."""
    if error is None:
        first = f"{root_doc}.html"
        page = f'<!doctype html><title>agglo</title><meta http-equiv="refresh" content="0; url={first}">'
        (Path(app.outdir) / "index.html").write_text(f'{page}<a href="{first}">The guide of agglo</a>\n')


def setup(app):
    app.connect("source-read", add_contents)
    app.connect("source-read", add_law_pages)
    app.connect("build-finished", lead_to_first_page)

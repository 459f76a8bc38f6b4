"""The program, the browser and pages in it.

AGGLO names the program, CHROMIUM the browser.
"""

import os
import subprocess
from pathlib import Path

import pytest
from page import Page
from playwright.sync_api import sync_playwright

ROOT = Path(__file__).resolve().parents[2]

# Software draws the pages here, and nothing is fetched beside them.
OPTIONS = [
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
]


@pytest.fixture(scope="session")
def agglo():
    """Calls the program with words; it must be content."""
    program = os.environ.get("AGGLO")
    if program is None:
        subprocess.run(["cargo", "build", "--quiet", "--locked", "--workspace", "--bins", "--examples"], cwd=ROOT, check=True)
        program = ROOT / "target/debug/agglo"

    def call(*words):
        done = subprocess.run([program, *words], capture_output=True, text=True, stdin=subprocess.DEVNULL)
        assert done.returncode == 0, f"agglo {' '.join(map(str, words))} ended with {done.returncode}:\n{done.stderr}"
        return done.stdout

    return call


@pytest.fixture(scope="session")
def finished(agglo, tmp_path_factory):
    """Runs a scenario or search with settings into a folder of its own; gives the folder."""

    def run(verb, file, *settings):
        folder = tmp_path_factory.mktemp("run") / "out"
        agglo(verb, file, "-o", folder, *(word for setting in settings for word in ("--set", setting)))
        return folder

    return run


@pytest.fixture(scope="session")
def browser():
    with sync_playwright() as playwright:
        program = os.environ.get("CHROMIUM", "/usr/bin/chromium")
        browser = playwright.chromium.launch(executable_path=program, args=OPTIONS)
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def opened(browser):
    """Opens the page of a folder from its file and waits until all of it is there."""
    pages = []

    def open_page(folder, *, width=1000, height=700, dark=False, touch=False):
        context = browser.new_context(
            viewport={"width": width, "height": height},
            color_scheme="dark" if dark else "light",
            has_touch=touch,
            reduced_motion="reduce",
        )
        # Software renders the pages, maybe beside other work.
        context.set_default_timeout(60_000)
        pages.append(Page(context, folder))
        return pages[-1]

    yield open_page
    for page in pages:
        page.close()


@pytest.fixture(scope="session")
def scenario():
    """The path of a shipped scenario."""
    return lambda name: ROOT / "scenarios" / f"{name}.toml"

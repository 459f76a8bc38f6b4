"""What `cargo package` makes of each crate stands alone: it holds what its sources include, and no dependency lacks a version.

Nothing is compiled, and no network is used. Needs `pytest` from PyPI, and cargo 1.90 or later, which packs crates that need each other.
"""

import json
import posixpath
import re
import subprocess
import tarfile
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PUBLISHED = ["agglo", "agglo-cli", "agglo-core", "agglo-view"]
# What only tests include stands in the project, of which packages hold no tests.
OF_TESTS = re.compile(r"(^|_)tests\.rs$|^testing\.rs$")
TESTS_INSIDE = re.compile(r"^#\[cfg\(test\)\]\nmod \w+ \{.*", re.MULTILINE | re.DOTALL)
# `include_str!("a")`, and `include_str!(concat!("a/", ...))`, of which the beginning says whether it leads outside.
INCLUDED = re.compile(r'include(?:_str|_bytes)?!\(\s*(concat!\(\s*)?"([^"]*)"')
ELSEWHERE = re.compile(r'#\[(path) = "([^"]*)"\]')


def said(command):
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def is_old():
    version = re.search(r"(\d+)\.(\d+)", said(["cargo", "--version"]))
    return (int(version[1]), int(version[2])) < (1, 90)


@pytest.fixture(scope="module")
def packages(tmp_path_factory):
    """By the name of a crate, what its package holds: paths and bytes."""
    if is_old():
        pytest.skip("cargo before 1.90 cannot pack crates that need each other")
    target = tmp_path_factory.mktemp("packages")
    crates = [word for name in PUBLISHED for word in ("--package", name)]
    said(["cargo", "package", *crates, "--no-verify", "--offline", "--allow-dirty", "--quiet", "--target-dir", str(target)])
    found = {}
    for path in sorted((target / "package").glob("*.crate")):
        with tarfile.open(path) as tar:
            members = tar.getmembers()
            odd = [member.name for member in members if not member.isfile()]
            assert not odd, f"{path.name} holds what is no file: {odd}"
            files = {member.name.split("/", 1)[1]: tar.extractfile(member).read() for member in members}
        found[tomllib.loads(files["Cargo.toml"].decode())["package"]["name"]] = files
    assert sorted(found) == PUBLISHED
    return found


def test_the_crates_to_be_published_are_those_that_are_held_here():
    metadata = json.loads(said(["cargo", "metadata", "--no-deps", "--offline", "--format-version", "1"]))
    # A list of registries: an empty one says that it is not published.
    assert sorted(package["name"] for package in metadata["packages"] if package["publish"] != []) == PUBLISHED


@pytest.mark.parametrize("name", PUBLISHED)
def test_a_package_says_what_it_is_and_holds_its_licenses(packages, name):
    files = packages[name]
    package = tomllib.loads(files["Cargo.toml"].decode())["package"]
    for key in ("description", "license", "readme", "rust-version", "keywords", "categories"):
        assert package.get(key), f"{name} does not say its {key}"
    assert files[package["readme"]].strip(), f"the readme of {name} is empty"
    for license in ("LICENSE-MIT", "LICENSE-APACHE"):
        assert files.get(license) == (ROOT / license).read_bytes(), f"{name} does not hold the project's {license}"


@pytest.mark.parametrize("name", PUBLISHED)
def test_a_package_holds_all_of_its_sources(packages, name):
    tracked = said(["git", "ls-files", "-z", f"crates/{name}/src"]).split("\0")
    sources = {path.removeprefix(f"crates/{name}/") for path in tracked if path and (ROOT / path).exists()}
    assert len(sources) > 20
    assert not sources - set(packages[name])


@pytest.mark.parametrize("name", PUBLISHED)
def test_what_the_sources_include_is_in_the_package(packages, name):
    files, lost = packages[name], []
    for path, text in files.items():
        if not path.startswith(("src/", "examples/")) or not path.endswith(".rs") or OF_TESTS.search(posixpath.basename(path)):
            continue
        code = TESTS_INSIDE.sub("", text.decode())
        for how, included in INCLUDED.findall(code) + ELSEWHERE.findall(code):
            place = posixpath.normpath(posixpath.join(posixpath.dirname(path), included))
            if place.startswith("..") or not (how.startswith("concat") or place in files):
                lost.append(f"{path}: {included}")
    assert not lost, "\n".join(lost)


def test_the_shipped_scenarios_are_in_the_library(packages):
    for scenario in (ROOT / "scenarios").glob("*.toml"):
        assert packages["agglo"][f"scenarios/{scenario.name}"] == scenario.read_bytes()


@pytest.mark.parametrize("name", PUBLISHED)
def test_each_dependency_has_a_version(packages, name):
    manifest = tomllib.loads(packages[name]["Cargo.toml"].decode())
    kinds = ("dependencies", "build-dependencies", "dev-dependencies")
    tables = [table.get(kind, {}) for table in (manifest, *manifest.get("target", {}).values()) for kind in kinds]
    needed = {name: how for table in tables for name, how in table.items()}
    assert len(needed) > 4
    for dependency, how in needed.items():
        assert how.get("version"), f"{name} needs any version of {dependency}"
        assert "path" not in how and "git" not in how
    assert "agglo-testing" not in needed, "agglo-testing is not published"

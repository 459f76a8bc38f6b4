"""The licenses of all crates let agglo be passed on under its own, and LICENSE-THIRD-PARTY has those that Cargo.lock asks for.

Needs `pytest` from PyPI, cargo, and the sources of all crates in Cargo.lock, which cargo fetches where they are missing.
"""

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/wheel"))

import licenses


@pytest.fixture(scope="module")
def data():
    try:
        return licenses.metadata()
    except licenses.NoSourcesError as error:
        # Builds fetch what their own system needs; without a network the rest may be missing.
        pytest.skip(f"not all sources are there: {error}")


@pytest.mark.parametrize(
    ("expression", "is_allowed"),
    [
        ("MIT OR Apache-2.0", True),
        ("Unlicense/MIT", True),
        ("MIT OR Apache-2.0 OR LGPL-2.1-or-later", True),
        ("(MIT OR Apache-2.0) AND Unicode-3.0", True),
        ("Apache-2.0 WITH LLVM-exception OR MIT", True),
        ("MIT AND GPL-3.0-only", False),
        ("GPL-3.0-only AND (MIT OR Apache-2.0)", False),
        ("GPL-2.0-only WITH Classpath-exception-2.0", False),
        ("none", False),
    ],
)
def test_an_expression_is_met_by_any_or_by_all(expression, is_allowed):
    assert licenses.is_allowed(expression) == is_allowed


def test_each_crate_can_be_passed_on_as_agglo_is(data):
    assert len(data["packages"]) > 200
    assert not licenses.faults(data)


def test_the_file_of_licenses_is_what_the_lock_file_asks_for(data):
    assert len(licenses.linked(data)) > 100
    # Not `==` on texts of a thousand lines, whose comparison pytest would print.
    is_right = licenses.FILE.read_text() == licenses.made(data)
    assert is_right, "write it anew: python3 tests/wheel/licenses.py --write"

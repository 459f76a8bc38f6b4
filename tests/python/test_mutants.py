"""The list of mistakes that no test can notice: each names code that is there, and a reason."""

import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
ACCEPTED = tomllib.loads((ROOT / "tests/mutants/accepted.toml").read_text()).get("accepted", [])


@pytest.mark.parametrize("entry", ACCEPTED, ids=lambda entry: f"{entry.get('file')}: {entry.get('change')}")
def test_an_accepted_mutant_names_code_that_is_there_and_a_reason(entry):
    assert set(entry) <= {"file", "change", "code", "reason"}, "a key that nothing reads"
    assert len(entry["reason"].split()) > 4, "a reason is a sentence"
    function = entry["change"].rsplit(" in ", 1)[-1].split("::")[-1] if " in " in entry["change"] else ""
    text = (ROOT / entry["file"]).read_text()
    assert f"fn {function}" in text, f"{entry['file']} has no function {function}"
    assert any(entry.get("code", "") in line for line in text.splitlines()), f"no line holds {entry.get('code')}"

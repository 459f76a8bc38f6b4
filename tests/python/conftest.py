"""What the tests run, built."""

import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def built():
    """The folder of the program and its examples. They are built together as `cargo test` does, so that nothing is built twice."""
    command = ["cargo", "build", "--quiet", "--locked", "--workspace", "--bins", "--examples"]
    subprocess.run(command, cwd=ROOT, check=True)
    return ROOT / "target/debug"

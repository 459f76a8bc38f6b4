#!/usr/bin/env python3
"""Draws the pictures of docs/gallery.md by the commands that stand there.

    cargo build --release && python3 docs/pictures/gallery.py

Runs go to a temporary folder. AGGLO names another program than target/release/agglo.
"""

import os
import re
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("AGGLO", ROOT / "target/release/agglo")).resolve()


def main():
    page = (ROOT / "docs/gallery.md").read_text()
    with tempfile.TemporaryDirectory() as place:
        # The commands name scenarios and pictures from the project's folder, and runs below out/.
        for name in ("scenarios", "docs"):
            (Path(place) / name).symlink_to(ROOT / name)
        (Path(place) / "agglo").symlink_to(PROGRAM)
        environment = {**os.environ, "PATH": f"{place}{os.pathsep}{os.environ['PATH']}"}
        (ROOT / "docs/pictures/gallery").mkdir(exist_ok=True)
        for commands in re.findall(r"^```sh\n(.*?)^```", page, re.DOTALL | re.MULTILINE):
            if "docs/pictures/gallery/" in commands:
                subprocess.run(["bash", "-e", "-c", commands], cwd=place, env=environment, check=True)


if __name__ == "__main__":
    main()

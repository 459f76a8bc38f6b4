"""The program `agglo`."""

from __future__ import annotations

import signal
import sys

from agglo import _agglo


def main() -> None:
    """Does what the command line says, as the program does that is built without Python."""
    # Ctrl-C is heard by the program itself.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(_agglo.act_on(["agglo", *sys.argv[1:]]))

"""What can go wrong."""

from __future__ import annotations

from typing import TypedDict


class Fault(TypedDict):
    """One thing that is wrong with a scenario."""

    key: str
    message: str
    help: str | None
    line: int | None
    column: int | None
    setting: str | None


class AggloError(Exception):
    """Any error of agglo."""


class InputError(AggloError, ValueError):
    """What was asked for cannot be done: the input has to change."""


class ScenarioError(InputError):
    """A scenario has faults: all of them at once.

    Attributes:
        faults: Dicts with the path of the key, what was found and what is allowed, what to do, line and column from 1, and the
            setting, where it was one that is at fault.
    """

    def __init__(self, message: str, faults: list[Fault]) -> None:
        super().__init__(message, faults)
        self.faults = faults

    def __str__(self) -> str:
        return str(self.args[0])


class PackageError(ImportError, InputError):
    """A package is missing that is not needed otherwise; the message says what to install."""


class RunError(AggloError, RuntimeError):
    """Something failed on the way: a step, a file, a stop."""

"""Puts small mistakes into the physics, one at a time, and says which of them no test noticed. `./test.sh --mutants` runs it.

cargo-mutants makes the mistakes: a sign, an operator, a comparison, a case left out, a function that returns 0. They are made in a copy
of the sources, target/mutants/tree, and tried by more and more tests: those of the same folder, which are quick and notice most;
those of the libraries; all in Rust. The order is shuffled, so that a run within a budget looks at a sample of all.

AGGLO_MUTANTS_MINUTES: the budget, 60 if not given. After it no further mistake is begun.
AGGLO_MUTANTS_SEED: another order; if not given, each commit has its own.
AGGLO_MUTANTS_FILES: globs of files, for a look at these alone: "crates/agglo-core/src/contact/**/*.rs".
"""

import fcntl
import json
import os
import random
import re
import shutil
import subprocess
import sys
import time
import tomllib
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
ACCEPTED = Path(__file__).with_name("accepted.toml")
HERE = ROOT / "target/mutants"
TREE = HERE / "tree"

# The laws, the engines, the measures and the rows.
FILES = [
    *(f"crates/agglo-core/src/{folder}/**/*.rs" for folder in ("acoustics", "contact", "engine", "fields", "impact", "measure")),
    *(f"crates/agglo/src/run/{name}" for name in ("hard/*.rs", "soft/*.rs", "summary.rs", "tables.rs")),
    *(f"crates/agglo/src/record/{name}" for name in ("series.rs", "frames/*.rs")),
]

# The crates that have such files, and those whose tests look at what these files say.
CRATES = ["agglo", "agglo-core"]
LOOKING = [*CRATES, "agglo-view"]

# By what a mutant is tried, until which share of the budget, the crates whose tests are run (all if there are none), what of them is
# built, and the names of the tests.
ROUNDS = [
    ("of its folder", 0.5, lambda mutant: [crate(mutant)], ["--lib"], lambda mutant: [f"{module(mutant)}::"]),
    ("of the libraries", 0.7, lambda mutant: LOOKING, ["--lib"], lambda mutant: []),
    ("in Rust", 1.0, lambda mutant: [], ["--bins", "--tests"], lambda mutant: []),
]

# How cargo-mutants calls what came of one.
OUTCOMES = {
    "CaughtMutant": "caught",
    "MissedMutant": "survived",
    "Unviable": "not built",
    "Timeout": "timed out",
}

# A mutant that hangs is given up after so many times what the tests take, or after this [s] where they are quick.
PATIENCE = 5
LEAST_PATIENCE_S = 60


def claim_the_copy():
    """One check at a time works in the copy; gives what must be kept until its end."""
    HERE.mkdir(parents=True, exist_ok=True)
    lock = (HERE / "lock").open("w")
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        sys.exit(f"error: another check of mutants is at work in {HERE}")
    return lock


def copy_sources():
    """Brings the copy to the state of the sources. Files that are the same keep their times, so that little is built anew."""
    command = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    listed = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout
    names = {name for name in listed.split("\0") if name and ((ROOT / name).is_file() or (ROOT / name).is_symlink())}
    for name in names:
        source, copy = ROOT / name, TREE / name
        if source.is_symlink():
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.unlink(missing_ok=True)
            copy.symlink_to(source.readlink())
        elif not copy.is_file() or copy.read_bytes() != source.read_bytes():
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, copy)
            shutil.copymode(source, copy)
    for folder, folders, files in os.walk(TREE):
        if Path(folder) == TREE and "target" in folders:
            folders.remove("target")
        for file in files:
            path = Path(folder) / file
            if str(path.relative_to(TREE)) not in names:
                path.unlink()


def cargo_mutants(*words, **more):
    program = os.environ.get("CARGO_MUTANTS", "cargo-mutants")
    return subprocess.run([program, "mutants", "--no-config", *words], cwd=TREE, text=True, **more)


def all_mutants():
    """Every mutant of the files: its name, its file, what it does, and the line of code that it changes."""
    files = os.environ.get("AGGLO_MUTANTS_FILES", "").split() or FILES
    globs = [word for file in files for word in ("--file", file)]
    done = cargo_mutants("--list", "--json", *packages(CRATES), *globs, stdout=subprocess.PIPE, check=True)
    found = []
    for entry in json.loads(done.stdout):
        line = entry["span"]["start"]["line"]
        code = (TREE / entry["file"]).read_text().splitlines()[line - 1].strip()
        change = re.sub(r"^[^ ]*:\d+:\d+: ", "", entry["name"])
        found.append({"name": entry["name"], "file": entry["file"], "change": change, "code": code})
    return found


def is_accepted(mutant, entry):
    """Numbers of lines change with every edit: a mutant is known by its file, what it does, and the code of its line."""
    same = mutant["file"] == entry["file"] and mutant["change"] == entry["change"]
    return same and entry.get("code", "") in mutant["code"]


def sort_out(mutants):
    """Leaves those that are accepted out; what is accepted and no longer there is a fault."""
    accepted = tomllib.loads(ACCEPTED.read_text()).get("accepted", [])
    for entry in accepted:
        if missing := {"file", "change", "reason"} - set(entry):
            sys.exit(f"error: {ACCEPTED}: an entry has no {', '.join(sorted(missing))}: {entry}")
    left = [mutant for mutant in mutants if not any(is_accepted(mutant, entry) for entry in accepted)]
    seen = {mutant["file"] for mutant in mutants}
    looked_for = [entry for entry in accepted if entry["file"] in seen or "AGGLO_MUTANTS_FILES" not in os.environ]
    stale = [entry for entry in looked_for if not any(is_accepted(mutant, entry) for mutant in mutants)]
    return left, stale


def order(mutants):
    """Shuffles them, each commit in its own way if nothing else is said."""
    seed = os.environ.get("AGGLO_MUTANTS_SEED")
    if seed is None:
        command = ["git", "rev-parse", "--short", "HEAD"]
        seed = subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout.strip()
    random.Random(seed).shuffle(mutants)
    return seed


def packages(crates):
    """How cargo is told of crates."""
    return [word for name in crates for word in ("--package", name)] or ["--workspace"]


def crate(mutant):
    """The crate of a mutant's file."""
    return Path(mutant["file"]).parts[1]


def module(mutant):
    """The folder of a mutant's file as the names of tests have it, two deep: "engine::soft" of engine/soft/rays/pulses.rs."""
    return "::".join(Path(mutant["file"]).parts[3:-1][:2])


def tests_pass(crates, targets, names):
    """Builds and runs tests on the copy without a mistake; gives the seconds that the tests took."""
    command = ["cargo", "test", "--quiet", "--locked", "--profile", "mutants", *packages(crates), *targets]
    subprocess.run([*command, "--no-run"], cwd=TREE, check=True, stdin=subprocess.DEVNULL)
    begun = time.monotonic()
    done = subprocess.run([*command, *names], cwd=TREE, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"error: without a mistake, {' '.join(command)} {' '.join(names)} fails:\n{done.stdout}\n{done.stderr}")
    return time.monotonic() - begun


def outcome(mutant, crates, targets, names, patience_s):
    """What these tests say of a mutant."""
    shutil.rmtree(HERE / "mutants.out", ignore_errors=True)
    named = ["--package", crate(mutant), "--file", mutant["file"], "--re", f"^{re.escape(mutant['name'])}$"]
    # What to build is said to every cargo: else each mutant would build all tests before it runs some.
    built = [f"--cargo-arg={word}" for word in ("--locked", *targets)]
    tested = [f"--test-package={name}" for name in crates] or ["--test-workspace=true"]
    how = ["--in-place", "--baseline=skip", "--profile=mutants", f"--output={HERE}", "--colors=never"]
    limits = [f"--timeout={patience_s:.0f}", "--build-timeout=1800"]
    asked = cargo_mutants(*named, *built, *tested, *how, *limits, "--", *names, capture_output=True)
    told = HERE / "mutants.out/outcomes.json"
    results = json.loads(told.read_text())["outcomes"] if told.exists() else []
    if len(results) != 1 or results[0]["summary"] not in OUTCOMES:
        sys.exit(f"error: cargo-mutants tried {len(results)} mutants by the name {mutant['name']}:\n{asked.stdout}{asked.stderr}")
    return OUTCOMES[results[0]["summary"]]


class Round:
    """Mutants tried by some tests until a time."""

    def __init__(self, what, deadline, crates_for, targets, names_for):
        self.what = what
        self.deadline = deadline
        self.crates_for = crates_for
        self.targets = targets
        self.names_for = names_for
        self.patience_s = {}
        self.verdicts = {}

    def is_over(self):
        return time.monotonic() > self.deadline

    def patience(self, crates, names):
        """How long these tests may take [s]; without a mistake they must pass."""
        key = " ".join([*crates, *names])
        if key not in self.patience_s:
            self.patience_s[key] = max(LEAST_PATIENCE_S, PATIENCE * tests_pass(crates, self.targets, names))
        return self.patience_s[key]

    def try_all(self, mutants):
        """Gives those that survived; `verdicts` tells of each that was tried."""
        if mutants and not self.is_over():
            print(f"by the tests {self.what}:", flush=True)
        survivors = []
        for mutant in mutants:
            if self.is_over():
                break
            crates, names = self.crates_for(mutant), self.names_for(mutant)
            patience_s = self.patience(crates, names)
            begun = time.monotonic()
            verdict = outcome(mutant, crates, self.targets, names, patience_s)
            self.verdicts[mutant["name"]] = verdict
            if verdict == "survived":
                survivors.append(mutant)
            print(f"{verdict:<9} {time.monotonic() - begun:4.0f} s  {mutant['name']}", flush=True)
        return survivors


def tell(what, mutants):
    for mutant in mutants:
        print(f"\n{what}: {mutant['name']}\n    {mutant['code']}")


def main():
    minutes = float(os.environ.get("AGGLO_MUTANTS_MINUTES", "60"))
    begun = time.monotonic()
    lock = claim_the_copy()
    copy_sources()
    mutants = all_mutants()
    left, stale = sort_out(mutants)
    seed = order(left)
    print(f"{len(mutants)} mutants, {len(mutants) - len(left)} of them accepted; seed {seed}, {minutes:g} minutes", flush=True)
    rounds = [Round(what, begun + 60 * minutes * share, *how) for what, share, *how in ROUNDS]
    verdicts, passed, undecided = {}, left, []
    for number, tried in enumerate(rounds):
        survivors = tried.try_all(passed)
        verdicts.update(tried.verdicts)
        if number > 0:
            undecided += [mutant for mutant in passed if mutant["name"] not in tried.verdicts]
        passed = survivors
    tell("no test noticed", passed)
    tell("passed by some tests, and there was no time for the others", undecided)
    for entry in stale:
        print(f"\nno longer there, take it off {ACCEPTED.relative_to(ROOT)}: {entry['change']} in {entry['file']}")
    counts = Counter(verdicts.values())
    counts["survived"] -= len(undecided)
    told = ", ".join(f"{counts[verdict]} {verdict}" for verdict in OUTCOMES.values())
    lock.close()
    print(f"\n{len(verdicts)} of {len(left)} mutants tried: {told}, {len(undecided)} undecided; seed {seed}")
    # A budget within which nothing was tried shows nothing.
    return 1 if passed or undecided or stale or (left and not verdicts) else 0


if __name__ == "__main__":
    sys.exit(main())

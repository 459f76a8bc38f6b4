"""The scripts of examples/slurm, with stand-ins for Slurm's commands: what they submit, requeue and leave."""

import json
import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SLURM = ROOT / "examples/slurm"

# `sbatch` runs a job at once, each task of an array beside the others, and again as long as it asks for that by `scontrol requeue`.
# The first time it may be given less time than later ones: how much a session gets done in a given time is up to the machine.
SBATCH = r"""#!/usr/bin/env bash
set -euo pipefail
array= parsable=
while [[ $1 == --* ]]; do
    case $1 in
    --array=1-*) array=${1#--array=1-} ;;
    --dependency=afterok:77) [[ $(<"$STATE/array") == 0 ]] || exit 1 ;;
    --parsable) parsable=yes ;;
    *) exit 1 ;;
    esac
    shift
done
bash -n "$1"
queue() {
    local name=$1 code
    shift
    export SLURM_JOB_ID=$name
    local first=${FIRST_WALL_TIME:-}
    while true; do
        code=0
        ${first:+env "AGGLO_WALL_TIME=$first"} bash "$@" >>"$STATE/$name.log" 2>&1 || code=$?
        first=
        echo "$code" >>"$STATE/$name.codes"
        [[ -e $STATE/$name.requeue ]] || return "$code"
        rm "$STATE/$name.requeue"
    done
}
if [[ -n $array ]]; then
    export SLURM_ARRAY_JOB_ID=77
    tasks=()
    for task in $(seq "$array"); do
        SLURM_ARRAY_TASK_ID=$task queue "77_$task" "$@" &
        tasks+=($!)
    done
    failed=0
    for task in "${tasks[@]}"; do wait "$task" || failed=1; done
    echo $failed >"$STATE/array"
    [[ -z $parsable ]] || echo 77
else
    queue 78 "$@"
fi
"""
SCONTROL = """#!/usr/bin/env bash
set -euo pipefail
[[ $1 == requeue ]]
touch "$STATE/$2.requeue"
"""


@pytest.fixture
def slurm(built, tmp_path):
    """Runs a command with the stand-ins, and gives what they noted."""
    commands, state = tmp_path / "bin", tmp_path / "state"
    commands.mkdir()
    state.mkdir()
    for name, text in [("sbatch", SBATCH), ("scontrol", SCONTROL)]:
        (commands / name).write_text(text)
        (commands / name).chmod(0o755)

    def run(*command, **environment):
        path = f"{commands}{os.pathsep}{built}{os.pathsep}{os.environ['PATH']}"
        everything = {**os.environ, **environment, "PATH": path, "STATE": str(state), "SLURM_CPUS_PER_TASK": "1"}
        done = subprocess.run(list(map(str, command)), cwd=tmp_path, env=everything, capture_output=True, text=True, timeout=300)
        logs = "\n".join(f"{log.name}:\n{log.read_text()}" for log in sorted(state.glob("*.log")))
        assert done.returncode == 0, done.stdout + done.stderr + logs
        return {codes.stem: [int(code) for code in codes.read_text().split()] for codes in state.glob("*.codes")}

    return run


def small_study(folder):
    """The shipped study, with fewer and smaller runs."""
    text = (SLURM / "study.toml").read_text()
    for old, new in [
        ("levels = 16", "levels = 5"),
        ("replicates = 32", "replicates = 3"),
        ("settings = [", "settings = ['grains.0.size.length_ratio.count=150', 'grains.0.placement.fill.count=150', "),
    ]:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    (folder / "study.toml").write_text(text)


def without_times(folder):
    """All that a folder holds, but for the page and wall times."""
    files = {str(file.relative_to(folder)): file.read_bytes() for file in sorted(folder.rglob("*")) if file.is_file()}
    summary = json.loads(files.pop("summary.json"))
    summary.pop("wall_s")
    return {name: text for name, text in files.items() if name not in ("report.html", "report.md", ".agglo.lock")} | {
        "summary": summary
    }


def test_a_job_array_gives_the_folder_of_one_process(slurm, built, tmp_path):
    small_study(tmp_path)
    codes = slurm(SLURM / "submit-study.sh", "study.toml", "3", "out")
    assert codes == {"77_1": [0], "77_2": [0], "77_3": [0], "78": [0]}
    subprocess.run([built / "agglo", "study", "study.toml", "-o", "alone"], cwd=tmp_path, check=True, capture_output=True)
    assert without_times(tmp_path / "out/whole") == without_times(tmp_path / "alone")


def test_jobs_that_run_out_of_time_are_queued_again(slurm, built, tmp_path):
    small_study(tmp_path)
    codes = slurm(SLURM / "submit-study.sh", "study.toml", "2", "out", FIRST_WALL_TIME="1 us")
    assert codes == {"77_1": [3, 0], "77_2": [3, 0], "78": [0]}
    subprocess.run([built / "agglo", "study", "study.toml", "-o", "alone"], cwd=tmp_path, check=True, capture_output=True)
    assert without_times(tmp_path / "out/whole") == without_times(tmp_path / "alone")


def test_a_run_that_runs_out_of_time_goes_on(slurm, built, tmp_path):
    settings = ["--set", "grains.0.placement.random.count=300", "--set", "time.end=60 ms", "--set", "output.checkpoints=5 ms"]
    new = subprocess.run([built / "agglo", "new", "acoustic"], check=True, capture_output=True, text=True).stdout
    (tmp_path / "new.toml").write_text(new)
    subprocess.run(
        [built / "agglo", "run", "new.toml", "-o", "alone", "--no-report", *settings],
        cwd=tmp_path,
        check=True,
        capture_output=True,
    )
    # The scenario of the first run has its settings.
    codes = slurm("sbatch", SLURM / "run-requeue.sh", "run", "alone/scenario.toml", "out/run", FIRST_WALL_TIME="1 us")
    assert codes == {"78": [3, 0]}
    for table in sorted((tmp_path / "alone/series").glob("*.csv")):
        assert (tmp_path / "out/run/series" / table.name).read_bytes() == table.read_bytes(), table.name


def test_what_fails_is_not_queued_again(slurm, tmp_path):
    (tmp_path / "bad.toml").write_text("version = 1\n")
    with pytest.raises(AssertionError, match="is missing"):
        slurm("sbatch", SLURM / "run-requeue.sh", "run", "bad.toml", "out/run")
    assert (tmp_path / "state/78.codes").read_text().split() == ["2"]

"""A search on ranks of MPI, through mpi4py.futures, has the files of one without."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import agglo
import pytest
from test_search import campaign, files

SCRIPT = """
import sys
import agglo
from mpi4py.futures import MPIPoolExecutor

if __name__ == "__main__":
    with MPIPoolExecutor() as pool:
        agglo.search(agglo.Campaign.from_file(sys.argv[1]), sys.argv[2], executor=pool)
        print("workers:", pool.num_workers)
"""

# What Open MPI wants to hear where there are fewer processors than ranks, or no other user than root; others do not mind.
OPEN_MPI = {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "PRTE_ALLOW_RUN_AS_ROOT": "1",
    "PRTE_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "PRTE_MCA_rmaps_default_mapping_policy": ":oversubscribe",
}


@pytest.mark.parametrize("ranks", [2, 3])
def test_a_search_on_ranks_of_mpi_has_the_same_files(tmp_path, ranks):
    pytest.importorskip("mpi4py")
    # An MPI from PyPI stands beside the interpreter.
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    mpiexec = shutil.which("mpiexec", path=path)
    if mpiexec is None:
        pytest.skip("mpiexec is not installed")
    agglo.search(campaign(), tmp_path / "here")
    (tmp_path / "script.py").write_text(SCRIPT)
    (tmp_path / "mine.toml").write_text(campaign().to_toml())
    python = [sys.executable, "-m", "mpi4py.futures", "script.py", "mine.toml", "mpi"]
    command = [mpiexec, "-n", str(ranks), *python]
    environment = os.environ | OPEN_MPI | {"PATH": path}
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr
    assert f"workers: {ranks - 1}" in done.stdout
    assert files(tmp_path / "mpi") == files(tmp_path / "here")

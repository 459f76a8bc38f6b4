"""Programs that read tables get the numbers that agglo meant.

Needs `numpy` and `pytest` from PyPI, and cargo.
"""

import csv
import struct
import subprocess

import numpy as np
import pytest


@pytest.fixture(scope="module")
def numbers(tmp_path_factory, built):
    out = tmp_path_factory.mktemp("tables")
    subprocess.run([built / "examples/write_frames", out], check=True)
    return out / "numbers.csv"


def rows(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def meant(row):
    return struct.unpack(">d", struct.pack(">II", int(row["high_bits"]), int(row["low_bits"])))[0]


def test_csv_reads_back_every_double(numbers):
    table = rows(numbers)
    assert len(table) == 11
    for row in table:
        assert float(row["value"]) == meant(row), row
        assert len(row["value"]) <= 24, row


def test_numpy_reads_back_every_double(numbers):
    values = np.genfromtxt(numbers, delimiter=",", names=True)["value"]
    assert values.tolist() == [meant(row) for row in rows(numbers)]


def test_pandas_reads_back_every_double(numbers):
    pandas = pytest.importorskip("pandas")
    table = pandas.read_csv(numbers, float_precision="round_trip")
    assert table["value"].tolist() == [meant(row) for row in rows(numbers)]
    # Its default reader may be off by the last digit, but not by more: 1e-28 is not 0.
    fast = pandas.read_csv(numbers)["value"].to_numpy()
    assert np.allclose(fast[:4], table["value"][:4], rtol=1e-15, atol=0.0)


def test_counts_are_whole_numbers(numbers, built, tmp_path):
    assert {row["count"] for row in rows(numbers)} == {"1512"}
    run = tmp_path / "run"
    scenario = tmp_path / "reacting.toml"
    command = [built / "agglo", "new", "reacting"]
    scenario.write_text(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    command = [built / "agglo", "run", scenario, "-o", run, "--no-report", "--set", "time.end=1 ms"]
    subprocess.run(command, check=True, capture_output=True)
    counts = {
        "series/grains.csv": ["grains", "largest_primaries"],
        "series/impacts.csv": ["impacts", "bounces", "merges", "fragmentations"],
        "series/sizes.csv": ["lower_primaries", "upper_primaries", "grains"],
        "kernels.csv": ["a_lower_primaries", "collisions", "merges"],
        "breakage.csv": ["lower_primaries", "grains", "breakages"],
    }
    for name, columns in counts.items():
        table = rows(run / name)
        assert table, name
        for row in table:
            for column in columns:
                int(row[column])

from pathlib import Path

import numpy as np
import pytest

from tests.demo.component_modules import load

PathRecord = load("path_logger/path_record.py").PathRecord


def at(x: float, z: float) -> tuple[float, ...]:
    return (x, z, 0.5, 1.0, 2.0, 0.25, 300.0, 0.1)


def test_path_record_adds_distances_within_run_only() -> None:
    record = PathRecord()
    for time, x in ((0.0, 0.0), (0.1, 30.0), (0.2, 60.0), (0.0, 1000.0), (0.1, 1005.0)):
        record.add(time, at(x, 0.0))
    assert record.runs == 2
    assert record.distance == pytest.approx(65)
    assert [sample.run for sample in record.samples] == [0, 0, 0, 1, 1]


def test_path_record_skips_close_samples_but_counts_time() -> None:
    record = PathRecord(interval=0.1)
    for i in range(11):
        record.add(i * 0.04, at(i * 10.0, 0.0))
    assert [round(sample.time_s, 2) for sample in record.samples] == [0.0, 0.12, 0.24, 0.36]
    assert record.time == pytest.approx(0.4)
    assert record.runs == 1
    record.add(0.0, at(0.0, 0.0))  # the base has begun again
    assert record.runs == 2


def test_path_record_file_has_names_and_numbers(tmp_path: Path) -> None:
    record = PathRecord()
    record.add(0.5, at(10.0, -20.0))
    record.add(1.0, at(11.0, -20.0))
    path = tmp_path / "new" / "path.csv"
    record.write(path)
    rows = np.genfromtxt(path, delimiter=",", names=True)
    assert rows["x_mm"].tolist() == [10, 11]
    assert rows["z_mm"].tolist() == [-20, -20]
    assert rows["time_s"].tolist() == [0.5, 1.0]
    assert [value.name for value in path.parent.iterdir()] == ["path.csv"]


def test_path_record_of_empty_path_has_header(tmp_path: Path) -> None:
    PathRecord().write(tmp_path / "path.csv")
    (line,) = (tmp_path / "path.csv").read_text().splitlines()
    assert line.startswith("run,time_s,x_mm")

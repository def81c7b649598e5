"""Descriptions and user code change in turn: no code is lost, and the component runs."""

from __future__ import annotations

import json
import random
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.regeneration.random_descriptions import RandomDescriptions
from tests.regeneration.random_editor import RandomEditor
from tests.regeneration.talker_component import TalkerComponent
from tests.regeneration.test_stubs import is_within

ROUNDS = 50
FEW = [(seed, 10) for seed in range(2)]
MANY = [pytest.param(seed, ROUNDS, marks=pytest.mark.slow) for seed in range(100, 110)]


class ComponentRunner:
    """Runs components, one at a time."""

    def __init__(self) -> None:
        program = Path(__file__).with_name("run_once.py")
        self.process = subprocess.Popen(
            [sys.executable, program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )

    def __call__(self, folder: Path) -> tuple[int, str]:
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        self.process.stdin.write(f"{folder}\n")
        self.process.stdin.flush()
        code, output = json.loads(self.process.stdout.readline())
        return code, output


@pytest.fixture(scope="module")
def runner() -> Iterator[ComponentRunner]:
    process_runner = ComponentRunner()
    with process_runner.process:
        yield process_runner
        assert process_runner.process.stdin is not None
        process_runner.process.stdin.close()


def write_descriptions(folder: Path, descriptions: RandomDescriptions) -> None:
    (folder / "Talk.idsl").write_text(descriptions.idsl())
    (folder / "talker.pdsl").write_text(descriptions.pdsl())
    (folder / "talker.smdsl").write_text(descriptions.smdsl())
    (folder / "talker.cdsl").write_text(descriptions.cdsl())


@pytest.mark.parametrize(("seed", "rounds"), [*FEW, *MANY])
def test_regeneration_keeps_user_code_over_random_rounds(
    tmp_path: Path, runner: ComponentRunner, seed: int, rounds: int
) -> None:
    rng = random.Random(seed)
    descriptions, editor = RandomDescriptions(rng), RandomEditor(rng)
    talker = TalkerComponent(tmp_path)
    write_descriptions(tmp_path, descriptions)
    talker.generate()
    known: set[str] = set()
    for number in range(rounds):
        for _ in range(rng.randrange(4)):
            text = talker.worker.read_bytes().decode()
            talker.worker.write_bytes(editor.edit(text).encode())
        for _ in range(rng.randrange(3)):
            descriptions.edit()
        write_descriptions(tmp_path, descriptions)
        before = talker.worker.read_bytes().decode()
        findings = talker.generate()
        after = talker.worker.read_bytes().decode()
        where = f"seed {seed}, round {number}"
        assert is_within(before, after), where
        added = {d.span.text for d in findings if d.code.id == "RC611"}
        assert all(after.count(f"def {name}(") >= 1 for name in added), where
        assert (before == after) == (not added), where
        assert "\r\n" not in before or "\n" not in after.replace("\r\n", ""), where
        known |= {d.code.id for d in findings}
        code, output = runner(tmp_path)
        assert code == 0, f"{where}: {output}\n{after}"
        assert [d for d in talker.generate() if d.code.id == "RC611"] == [], where
    assert rounds < ROUNDS or known >= {"RC611", "RC614"}

"""Model and user change the same component in turn: nothing is lost, and it always runs."""

from __future__ import annotations

import json
import random
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.regeneration.random_model import Model
from tests.regeneration.random_user import User
from tests.regeneration.regenerated import Talker
from tests.regeneration.test_stubs import is_within

ROUNDS = 50
FEW = [(seed, 10) for seed in range(2)]
MANY = [pytest.param(seed, ROUNDS, marks=pytest.mark.slow) for seed in range(100, 110)]


class Runner:
    """Runs components, one after another."""

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
def runner() -> Iterator[Runner]:
    process_runner = Runner()
    with process_runner.process:
        yield process_runner
        assert process_runner.process.stdin is not None
        process_runner.process.stdin.close()


def put(folder: Path, model: Model) -> None:
    (folder / "Talk.idsl").write_text(model.idsl())
    (folder / "talker.pdsl").write_text(model.pdsl())
    (folder / "talker.smdsl").write_text(model.smdsl())
    (folder / "talker.cdsl").write_text(model.cdsl())


@pytest.mark.parametrize(("seed", "rounds"), [*FEW, *MANY])
def test_rounds(tmp_path: Path, runner: Runner, seed: int, rounds: int) -> None:
    chance = random.Random(seed)
    model, user, talker = Model(chance), User(chance), Talker(tmp_path)
    put(tmp_path, model)
    talker.generate()
    known: set[str] = set()
    for number in range(rounds):
        for _ in range(chance.randrange(4)):
            text = talker.worker.read_bytes().decode()
            talker.worker.write_bytes(user.edit(text).encode())
        for _ in range(chance.randrange(3)):
            model.edit()
        put(tmp_path, model)
        before = talker.worker.read_bytes().decode()
        found = talker.generate()
        after = talker.worker.read_bytes().decode()
        where = f"seed {seed}, round {number}"
        assert is_within(before, after), where
        added = {d.span.text for d in found if d.code.id == "RC611"}
        assert all(after.count(f"def {name}(") >= 1 for name in added), where
        assert (before == after) == (not added), where
        assert "\r\n" not in before or "\n" not in after.replace("\r\n", ""), where
        known |= {d.code.id for d in found}
        code, output = runner(tmp_path)
        assert code == 0, f"{where}: {output}\n{after}"
        assert [d for d in talker.generate() if d.code.id == "RC611"] == [], where
    assert rounds < ROUNDS or known >= {"RC611", "RC614"}

"""Model files with another number somewhere: a world or a finding, never a traceback."""

from __future__ import annotations

import random
import re
from pathlib import Path

import pytest

from robocomp_dsl.cli.rcgen.simulation.simulator_model import model_world
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.hardware.description.scene import Scene
from robocomp_dsl.hardware.devices.errors import Diverged
from robocomp_dsl.simulation.world.simulation import Simulation, SimulationOptions
from tests.simulation.model_worlds import ARM, BOT

NUMBERS = re.compile(r'(?<=[" ])-?[\d.]+(?=[" ])')
OTHERS = ("nan", "-1", "0", "1e-9", "1e9", "5", "-0.3", "0.001", "1000")


def mutated(text: str, seed: int) -> str:
    chosen = random.Random(seed)
    places = chosen.sample(list(NUMBERS.finditer(text)), chosen.randint(1, 3))
    for place in sorted(places, key=lambda match: -match.start()):
        text = text[: place.start()] + chosen.choice(OTHERS) + text[place.end() :]
    return text


@pytest.mark.parametrize("seed", range(0, 60, 10))
@pytest.mark.parametrize(("text", "name"), [(ARM, "arm.xml"), (BOT, "bot.urdf")])
def test_model_file_with_other_numbers_loads_or_reports(
    text: str, name: str, seed: int, tmp_path: Path
) -> None:
    ran = 0
    for number in range(seed, seed + 10):
        (tmp_path / name).write_text(mutated(text, number))
        report = Report()
        result = model_world(tmp_path / name, (), report, lambda result: result)
        assert result is not None or report.has_errors
        if result is None or report.has_errors:
            continue
        (tmp_path / result.scene["model"]["file"]).write_text(result.model)
        scene = Scene.of_data(result.scene, tmp_path)
        simulation = Simulation(scene, SimulationOptions(step=result.step / 1000, diverged="stop"))
        try:
            simulation.advance(0.02)
        except Diverged:
            continue
        ran += 1
    assert ran > 2

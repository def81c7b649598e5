"""Any well-formed world: rcgen generates a simulator, and its world advances."""

from pathlib import Path

import pytest
from click.testing import CliRunner

from robocomp_dsl.check.passes import check_innermodel
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.cli.rcgen.simulation.simulator import command
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.scene.scene import lower_body
from robocomp_dsl.hardware.description.scene import Scene
from robocomp_dsl.hardware.devices.errors import Diverged
from robocomp_dsl.simulation.world.simulation import Simulation
from tests.innermodel.random_worlds import random_world
from tests.innermodel.world_files import place


def dry_run(path: Path) -> str:
    """What the dry run prints; anything but success fails."""
    done = CliRunner().invoke(command, [str(path), "--dry-run", "--format", "concise"])
    assert done.exception is None, (path, done.output, done.exception)
    return done.output


def run(path: Path) -> None:
    """Some steps; a world of extreme numbers may diverge and reports that."""
    body = check_innermodel(path, Workspace(()), Report())
    assert body is not None
    simulation = Simulation(Scene.of_data(lower_body(body)))
    try:
        simulation.world.advance(0.01)
    except Diverged:
        assert any("cannot be simulated" in note for note in simulation.notes)


@pytest.mark.parametrize("tens", range(6))
def test_simulator_of_random_world_is_generated_and_runs(tmp_path: Path, tens: int) -> None:
    for seed in range(1000 + 10 * tens, 1010 + 10 * tens):
        folder = tmp_path / str(seed)
        folder.mkdir()
        path = place(folder, random_world(seed))
        assert "InnerModelManager" in dry_run(path)
        run(path)


def test_simulator_port_names_are_unique_in_any_case(tmp_path: Path) -> None:
    names = ("simulation", "Simulation", "clock", "jointmotor", "Component", "a", "A", "a b", "a_b")
    inside = "".join(f'<imu id="{name}"/>' for name in names)
    path = place(tmp_path, {"world.xml": f'<innerModel>{inside}<joint id="j"/></innerModel>'})
    ports = [line.split()[-1].lower() for line in dry_run(path).splitlines()[1:]]
    assert len(ports) == len(names) + 4
    assert len(set(ports)) == len(ports)

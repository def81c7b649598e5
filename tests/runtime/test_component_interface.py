"""The Python side of the interfaces that the library itself calls is what rcgen makes of IDSL."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from robocomp_dsl.cli.rcgen import program

ROOT = Path(__file__).parents[2]
COMPONENT = """\
import "Component.idsl";
Component x { Communications { implements Component; requires Component; }; language Python; };
"""
CLOCK = """\
import "LockStep.idsl";
import "Clock.idsl";
Component x
{
    Communications { implements Follower, Leader; requires Follower, Leader; publishes Clock; };
    language Python;
};
"""
SIMULATION = """\
import "InnerModelManager.idsl";
import "Simulation.idsl";
Component x { Communications { requires Simulation, InnerModelManager; }; language Python; };
"""


@pytest.mark.parametrize(
    ("cdsl", "name"),
    [
        (COMPONENT, "runtime/component_interface"),
        (CLOCK, "runtime/clock_interface"),
        (SIMULATION, "hardware/simulation_interface"),
    ],
)
def test_the_generated_module_is_fresh(tmp_path: Path, cdsl: str, name: str) -> None:
    (tmp_path / "x.cdsl").write_text(cdsl)
    made = CliRunner().invoke(program, ["component", str(tmp_path / "x.cdsl")])
    assert made.exit_code == 0, made.output
    fresh = (tmp_path / "generated/interfaces.py").read_text()
    module = ROOT / f"robocomp_dsl/{name}.py"
    assert module.read_text() == fresh, (
        "an IDSL file in interfaces/ or the generator has changed:"
        f" put the new generated/interfaces.py into {module.relative_to(ROOT)}"
    )

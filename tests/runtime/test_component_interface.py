"""The interface modules of the library equal the output of rcgen."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from robocomp_dsl.cli.rcgen.main import program

ROOT = Path(__file__).parents[2]
COMPONENT = """\
import "Component.idsl";
Component x { Communications { implements Component; requires Component; }; language Python; };
"""
SCHEMA = """\
import "ComponentSchema.idsl";
Component x
{
    Communications { implements ComponentSchema; requires ComponentSchema; };
    language Python;
};
"""
CONNECTIONS = """\
import "ComponentConnections.idsl";
Component x
{
    Communications { implements ComponentConnections; requires ComponentConnections; };
    language Python;
};
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
        (COMPONENT, "runtime/component/component_interface"),
        (SCHEMA, "runtime/dynamic/schema_interface"),
        (CONNECTIONS, "runtime/connection/connections_interface"),
        (CLOCK, "runtime/time/clock_interface"),
        (SIMULATION, "simulation/simulation_interface"),
    ],
)
def test_generated_interface_module_is_up_to_date(tmp_path: Path, cdsl: str, name: str) -> None:
    (tmp_path / "x.cdsl").write_text(cdsl)
    result = CliRunner().invoke(program, ["component", str(tmp_path / "x.cdsl")])
    assert result.exit_code == 0, result.output
    for suffix in (".py", ".json"):
        fresh = (tmp_path / "x_generated/interfaces").with_suffix(suffix).read_text()
        file = ROOT / f"robocomp_dsl/{name}{suffix}"
        assert file.read_text() == fresh, (
            "an IDSL file in interfaces/ or the generator has changed:"
            f" put the new interfaces{suffix} into {file.relative_to(ROOT)}"
        )

"""The Python side of `Component` is what rcgen makes of its IDSL file."""

from __future__ import annotations

from pathlib import Path

from click.testing import CliRunner

from robocomp_dsl.cli.rcgen import program

ROOT = Path(__file__).parents[2]
CDSL = """\
import "Component.idsl";
Component x { Communications { implements Component; requires Component; }; language Python; };
"""


def test_the_generated_module_is_fresh(tmp_path: Path) -> None:
    (tmp_path / "x.cdsl").write_text(CDSL)
    made = CliRunner().invoke(program, ["component", str(tmp_path / "x.cdsl")])
    assert made.exit_code == 0, made.output
    fresh = (tmp_path / "generated/interfaces.py").read_text()
    module = ROOT / "robocomp_dsl/runtime/component_interface.py"
    assert module.read_text() == fresh, (
        "interfaces/Component.idsl or the generator has changed:"
        f" put the new generated/interfaces.py into {module.relative_to(ROOT)}"
    )

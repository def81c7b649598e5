"""Files of about 1000 lines in every language, without findings, and what they import.

In: a folder. Out: the path and text of each file by name. The sizes are far beyond real files: the
largest of the shipped descriptions has 61 lines.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import cycle, islice
from pathlib import Path

LINES = 1000
COMMENT = "// The next part of the file."
_PORTS = ("Laser", "JointMotor", "DifferentialRobot", "RGBD", "IMU", "GPS", "OmniRobot")
_CAMERA = """\
import "Laser.idsl";
import "IMU.idsl";
Component camera
{
    Communications { implements Laser; requires IMU optional; };
    parameters "camera.pdsl";
    language Python;
};
"""
_PARAMETERS = "ComponentParams camera\n{\n    rate float 15 [Hz] 1:60;\n};\n"


def write_large_files(folder: Path) -> dict[str, tuple[Path, str]]:
    """Write the files to `folder`; name of the kind to path and text."""
    Path(folder, "camera.cdsl").write_text(_CAMERA, encoding="utf-8")
    Path(folder, "camera.pdsl").write_text(_PARAMETERS, encoding="utf-8")
    texts = {
        "structs.idsl": _join("module Structs\n{\n", _structs(), "};\n"),
        "operations.idsl": _join("module M\n{\n  interface I\n  {\n", _operations(), "  };\n};\n"),
        "ports.cdsl": _join(_head_of_component(), _ports(), "    };\n    language Python;\n};\n"),
        "parameters.pdsl": _join("ComponentParams parameters\n{\n", _parameters(), "};\n"),
        "machine.smdsl": _machine(),
        "robots.ddsl": _join('import "camera.cdsl";\nDeployment robots\n{\n', _robots(), "};\n"),
        "topics.bdsl": _join("Bridge topics\n{\n    rate 20 Hz;\n", _topics(), "};\n"),
    }
    paths = {name: Path(folder, name) for name in texts}
    for name, path in paths.items():
        path.write_text(texts[name], encoding="utf-8")
    return {name: (path, texts[name]) for name, path in paths.items()}


def _join(head: str, items: Iterable[str], end: str) -> str:
    """The file with as many of the items as `LINES` allow, and a comment before every tenth."""
    lines = [*head.splitlines()]
    for number, item in enumerate(items):
        if len(lines) + len(end.splitlines()) >= LINES:
            break
        if number % 10 == 5:
            lines.append(f"    {COMMENT}")
        lines += item.splitlines()
    return "\n".join(lines) + "\n" + end


def _structs() -> Iterator[str]:
    for n in range(LINES):
        before = f"        S{n - 1} before;\n" if n % 5 else ""
        yield (
            f"    /** Number {n}. */\n    struct S{n}\n    {{\n        float x = 0 [mm];\n"
            f"{before}        int count;\n    }};\n    sequence<S{n}> L{n};"
        )


def _operations() -> Iterator[str]:
    return (f"    void go{n}(int a, out float b);" for n in range(LINES))


def _head_of_component() -> str:
    imports = "".join(f'import "{name}.idsl";\n' for name in _PORTS)
    return f"{imports}Component ports\n{{\n    Communications\n    {{\n"


def _ports() -> Iterator[str]:
    for n, name in enumerate(islice(cycle(_PORTS), LINES)):
        yield f"        requires {name} as port{n};"


def _parameters() -> Iterator[str]:
    for n in range(LINES):
        yield (
            f"    group{n}\n    {{\n        /** Radius {n}. */\n"
            f"        radius float 80 [mm] 10:1000;\n"
            f'        name string "x";\n        mode {{ fast, slow }} fast;\n    }};\n'
            f"    rate{n} int 3 1:9;"
        )


def _machine() -> str:
    states = ", ".join(f"s{n}" for n in range(1, 300))
    chain = (f"        s{n} => s{n + 1};" for n in range(299))
    edges = (f"        s{n % 300} => s{(n * 7 + 5) % 300} on event{n};" for n in range(LINES))
    head = f"machine\n{{\n    states {states};\n    initial_state s0;\n    transitions\n    {{\n"
    return _join(head, (*chain, *edges), "    };\n};\n")


def _robots() -> Iterator[str]:
    for n in range(LINES):
        yield (
            f"    component camera{n} : camera\n    {{\n        set rate = {1 + n % 60};\n"
            f"        ready within {1 + n % 9} s;\n    }};"
        )


def _topics() -> Iterator[str]:
    for n in range(LINES):
        yield (
            f'    input in{n} : double[3] [deg] over yarp at "/in{n}:o";\n'
            f'    output out{n} over yarp at "/out{n}:i"\n    {{\n'
            f"        rate 10 Hz;\n        item in{n} to [rad];\n    }};"
        )

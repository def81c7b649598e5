"""Live values that are kept for the next start: a file of ours beside the configuration.

In: the path of the configuration, values by path. Out: a YAML file `path: value`, read above the
configuration and below the command line; the file of the user stays as it is.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping as Values
from contextlib import suppress
from pathlib import Path

from robocomp_dsl.runtime.parameters.findings import Finding, Text
from robocomp_dsl.runtime.parameters.overrides import put, steps
from robocomp_dsl.runtime.parameters.schema import Value
from robocomp_dsl.runtime.parameters.tree import Mapping, Scalar

_SUFFIX = ".saved.yaml"
_HEAD = """\
# Live values, kept on request; read above {name} and below the command line.
# Written by the component: delete a line, or this file, to have the configuration count again.
"""


def beside(config: Path) -> Path:
    """Where the values that belong to a configuration are kept."""
    return config.with_name(f"{config.stem}{_SUFFIX}")


def is_kept(name: str) -> bool:
    """Whether a file of this name has kept values, and is no configuration."""
    return name.endswith(_SUFFIX)


def apply(root: Mapping, saved: Mapping, findings: list[Finding]) -> Mapping:
    """`root` with the kept values in their places."""
    for path, member in saved.members.items():
        found = steps(path)
        if found is None or not isinstance(member.value, Scalar):
            said = f"`{path:.80}` is not of the form `path: value`"
            findings.append(Finding(member.place, said, help="delete this line"))
            continue
        root = put(root, found, member.place, member.value, findings)
    return root


def paths(file: Path) -> list[str]:
    """What is kept in a file that was read without findings."""
    try:
        source = file.read_text(encoding="utf-8-sig")
    except OSError:
        return []
    from robocomp_dsl.runtime.parameters.yaml_text import read_yaml  # noqa: PLC0415 - slow to load

    root = read_yaml(Text(str(file), ()), source, [])
    return list(root.members) if root else []


def write(path: Path, config: Path, values: Values[str, Value]) -> None:
    """Put the values into the file, whole or not at all. Raises `OSError`."""
    rows = [f"{json.dumps(key)}: {_yaml(value)}\n" for key, value in sorted(values.items())]
    path.parent.mkdir(parents=True, exist_ok=True)
    new = path.with_name(f".{path.name}.new")
    try:
        new.write_text(_HEAD.format(name=config.name) + "".join(rows), encoding="utf-8")
        new.replace(path)
    except OSError:
        with suppress(OSError):
            new.unlink()
        raise


def _yaml(value: Value) -> str:
    if isinstance(value, str):
        inner = value.replace("\\", "\\\\").replace('"', '\\"')
        return '"' + "".join(c if c.isprintable() else f"\\U{ord(c):08x}" for c in inner) + '"'
    if isinstance(value, float) and not math.isfinite(value):
        return {"inf": ".inf", "-inf": "-.inf"}.get(str(value), ".nan")
    return json.dumps(value)

"""Saves live values for the next start, in a file beside the configuration.

In: the path of the configuration, values by path. Out: a YAML file `path: value`, which overrides
the configuration and is overridden by the command line. The configuration itself is not changed.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping as Values
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from robocomp_dsl.finding import Finding, SourceText
from robocomp_dsl.regular_file import read_text
from robocomp_dsl.runtime.parameters.overrides import parse_path, set_node
from robocomp_dsl.runtime.parameters.schema import Value
from robocomp_dsl.runtime.parameters.tree import Mapping

_SUFFIX = ".saved.yaml"
_HEADER = """\
# Saved live values; they override {name}; the command line overrides them.
# Written by the component: delete a line, or this file, to use the configuration again.
"""


def saved_path(config: Path) -> Path:
    """The file of saved values of a configuration."""
    return config.with_name(f"{config.stem}{_SUFFIX}")


def is_saved_file(name: str) -> bool:
    """Whether a file of this name holds saved values and is not a configuration."""
    return name.endswith(_SUFFIX)


def apply(root: Mapping, saved: Mapping, findings: list[Finding]) -> Mapping:
    """`root` with the saved values applied."""
    for path, member in saved.members.items():
        found = parse_path(path)
        if found is None or isinstance(member.value, Mapping):
            message = f"`{path:.80}` is not of the form `path: value`"
            findings.append(Finding(member.place, message, help="delete this line"))
            continue
        root = set_node(root, found, member.place, member.value, findings)
    return root


def saved_parameters(file: Path) -> list[str]:
    """The parameters in a file that was read without findings."""
    try:
        source = read_text(file, "utf-8-sig")
    except OSError:
        return []
    from robocomp_dsl.runtime.parameters.yaml_text import read_yaml  # noqa: PLC0415 - slow to load

    root = read_yaml(SourceText(str(file), ()), source, [])
    return list(root.members) if root else []


def write(path: Path, config: Path, values: Values[str, Value]) -> None:
    """Write the values to the file atomically. Raises `OSError`."""
    rows = [f"{json.dumps(key)}: {_yaml(value)}\n" for key, value in sorted(values.items())]
    path.parent.mkdir(parents=True, exist_ok=True)
    new = path.with_name(f".{path.name}.new")
    try:
        new.write_text(_HEADER.format(name=config.name) + "".join(rows), encoding="utf-8")
        new.replace(path)
    except OSError:
        with suppress(OSError):
            new.unlink()
        raise


def _yaml(value: Value) -> str:
    if isinstance(value, Sequence) and not isinstance(value, str):
        return f"[{', '.join(map(_yaml, value))}]"
    if isinstance(value, str):
        inner = value.replace("\\", "\\\\").replace('"', '\\"')
        return '"' + "".join(c if c.isprintable() else f"\\U{ord(c):08x}" for c in inner) + '"'
    if isinstance(value, float) and not math.isfinite(value):
        return {"inf": ".inf", "-inf": "-.inf"}.get(str(value), ".nan")
    return json.dumps(value)

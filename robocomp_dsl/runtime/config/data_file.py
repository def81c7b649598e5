"""Finds a file that a parameter names: a map, a description of the robot.

In: the words of the parameter, the configuration that they come from. Out: the path, or
`ConfigError` that lists every place in which the file is not.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.runtime.config.drop_ins import dropped
from robocomp_dsl.runtime.config.find import search
from robocomp_dsl.runtime.config.places import places
from robocomp_dsl.runtime.config.surroundings import Surroundings, surroundings
from robocomp_dsl.runtime.parameters.findings import (
    ConfigError,
    Finding,
    Place,
    Text,
    did_you_mean,
)


def data_file(
    name: str, parameter: str, config: Path | None = None, around: Surroundings | None = None
) -> Path:
    """The file `name`, as `parameter` says: beside `config`, then where configurations are found.

    An absolute path is taken as it is, one with `..` from the folder of `config` or the working
    folder. Raises `ConfigError`.
    """
    there = around or surroundings()
    tried = [one.expanduser() for one in _beside(name, config, there)]
    if not _leads_out(name):
        order = places((*there.roots, *dropped(there, [])), there.robot)
        tried += [one.path for one in search(name, order)]
    found = next((one for one in tried if _is_file(one)), None)
    if found is None:
        raise ConfigError([_nowhere(name, parameter, tried)])
    return found


def _beside(name: str, config: Path | None, around: Surroundings) -> list[Path]:
    folders = [config.absolute().parent] if config else []
    # An absolute name wins over the folder that it is joined to.
    return [folder / Path(name).expanduser() for folder in (*folders, around.working)]


def _leads_out(name: str) -> bool:
    path = Path(name).expanduser()
    return path.is_absolute() or ".." in path.parts or not path.parts or "\0" in name


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except OSError:  # a name that is too long, say
        return False


def _nowhere(name: str, parameter: str, tried: list[Path]) -> Finding:
    listed = "\n".join(f"  {one}" for one in dict.fromkeys(tried))
    near = did_you_mean(Path(name).name, _neighbours(tried))
    return Finding(
        Place(Text(f"parameter {parameter}", (name,)), 1, 1, max(1, len(name))),
        f"there is no file `{name:.200}`",
        label=near,
        help=f"`{parameter}` is looked for in these places, in this order:\n{listed}",
    )


def _neighbours(tried: list[Path]) -> list[str]:
    names: list[str] = []
    for one in tried:
        try:
            names += [p.name for p in one.parent.iterdir() if p.suffix == one.suffix]
        except OSError:
            continue
    return names

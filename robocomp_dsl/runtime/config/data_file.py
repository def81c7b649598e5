"""Finds a file that a parameter names, such as a map or a robot description.

In: the value of the parameter, the configuration file. Out: the path, or `ConfigError` that lists
all searched paths.
"""

from __future__ import annotations

from pathlib import Path

from robocomp_dsl.finding import Finding, Location, SourceText
from robocomp_dsl.runtime.config.candidates import search
from robocomp_dsl.runtime.config.drop_ins import drop_in_roots
from robocomp_dsl.runtime.config.search_environment import SearchEnvironment
from robocomp_dsl.runtime.config.search_paths import search_paths
from robocomp_dsl.runtime.parameters.errors import ConfigError, did_you_mean


def data_file(
    name: str,
    parameter: str,
    config: Path | None = None,
    environment: SearchEnvironment | None = None,
) -> Path:
    """The path of file `name`, the value of `parameter`.

    Searches the folder of `config`, the working folder, then the search paths of configurations.
    An absolute path is used as it is; a path with `..` is relative to the first two only. Raises
    `ConfigError`.
    """
    environment = environment or SearchEnvironment.from_environ()
    tried = [path.expanduser() for path in _direct_paths(name, config, environment)]
    if not _leaves_search_path(name):
        roots = (*environment.roots, *drop_in_roots(environment, []))
        order = search_paths(roots, environment.robot)
        tried += [candidate.path for candidate in search(name, order)]
    found = next((path for path in tried if _is_file(path)), None)
    if found is None:
        raise ConfigError([_not_found(name, parameter, tried)])
    return found


def _direct_paths(name: str, config: Path | None, environment: SearchEnvironment) -> list[Path]:
    folders = [config.absolute().parent] if config else []
    # Joining an absolute path to a folder gives the absolute path.
    return [folder / Path(name).expanduser() for folder in (*folders, environment.working_folder)]


def _leaves_search_path(name: str) -> bool:
    path = Path(name).expanduser()
    return path.is_absolute() or ".." in path.parts or not path.parts or "\0" in name


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except OSError:  # a name that is too long, say
        return False


def _not_found(name: str, parameter: str, tried: list[Path]) -> Finding:
    listed = "\n".join(f"  {entry}" for entry in dict.fromkeys(tried))
    near = did_you_mean(Path(name).name, _neighbours(tried))
    return Finding(
        Location(SourceText(f"parameter {parameter}", (name,)), 1, 1, max(1, len(name))),
        f"file not found: `{name:.200}`",
        label=near,
        help=f"`{parameter}` was looked for in this order:\n{listed}",
    )


def _neighbours(tried: list[Path]) -> list[str]:
    names: list[str] = []
    for path in tried:
        try:
            names += [p.name for p in path.parent.iterdir() if p.suffix == path.suffix]
        except OSError:
            continue
    return names

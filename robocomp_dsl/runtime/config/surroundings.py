"""Where configurations may be on this machine: the folders that the environment names.

In: environment variables and the working folder. Out: `Surroundings`. Nothing is looked into here.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import Enum
from pathlib import Path

APP = "robocomp"
DEFAULT_ROBOT = "default"


class Origin(Enum):
    """Whose folder it is; the earlier shadows the later."""

    WORKING = "working folder"
    USER = "user"
    INSTALLED = "installed"
    DROPPED = "path.d"


@dataclass(frozen=True, slots=True)
class Root:
    """A folder with `contexts/`, `robots/` and files of its own."""

    folder: Path
    origin: Origin


@dataclass(frozen=True, slots=True)
class Surroundings:
    """The folders, absolute; none of them need be there. `robot` names a folder in `robots/`."""

    working: Path
    config_home: Path
    data_home: Path
    config_dirs: tuple[Path, ...]
    data_dirs: tuple[Path, ...]
    robot: str = DEFAULT_ROBOT

    @property
    def roots(self) -> tuple[Root, ...]:
        """In the order of the search, without those that `path.d` adds."""
        made = [Root(self.working, Origin.WORKING)]
        made += [Root(one, Origin.USER) for one in (self.config_home, self.data_home)]
        made += [Root(one, Origin.INSTALLED) for one in (*self.config_dirs, *self.data_dirs)]
        return tuple(made)

    @property
    def drop_in_folders(self) -> tuple[Path, ...]:
        """Where drop-in files are looked for, those of the user first."""
        homes = (self.config_home, self.data_home, *self.config_dirs, *self.data_dirs)
        return tuple(dict.fromkeys(home / "path.d" for home in homes))


def surroundings(
    environment: Mapping[str, str] = os.environ, working: Path | None = None
) -> Surroundings:
    """What the variables `ROBOCOMP_*` say, and the XDG base directories where they say nothing."""
    from platformdirs import PlatformDirs  # noqa: PLC0415 - only a search needs it

    usual = PlatformDirs(APP, appauthor=False, multipath=True)
    here = (working or Path.cwd()).absolute()

    def listed(variable: str, otherwise: Iterable[str]) -> tuple[Path, ...]:
        said = [one for one in environment.get(variable, "").split(os.pathsep) if one]
        return tuple(dict.fromkeys(here / Path(one).expanduser() for one in said or otherwise))

    own = os.path.join(sys.prefix, "share", APP)  # noqa: PTH118 - one of a list of texts
    return Surroundings(
        working=here,
        config_home=listed("ROBOCOMP_CONFIG_HOME", [usual.user_config_dir])[0],
        data_home=listed("ROBOCOMP_DATA_HOME", [usual.user_data_dir])[0],
        config_dirs=listed("ROBOCOMP_CONFIG_DIRS", usual.site_config_dir.split(os.pathsep)),
        data_dirs=listed("ROBOCOMP_DATA_DIRS", [*usual.site_data_dir.split(os.pathsep), own]),
        robot=environment.get("ROBOCOMP_ROBOT_NAME") or DEFAULT_ROBOT,
    )

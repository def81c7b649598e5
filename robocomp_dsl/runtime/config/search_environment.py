"""The folders where configurations may be, from environment variables. Reads no folder.

In: environment variables and the working folder. Out: `SearchEnvironment`.
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
    """The origin of a folder; an earlier origin takes precedence over a later one."""

    WORKING = "working folder"
    USER = "user"
    INSTALLED = "installed"
    DROP_IN = "path.d"


@dataclass(frozen=True, slots=True)
class Root:
    """A folder with `contexts/`, `robots/` and files."""

    folder: Path
    origin: Origin


@dataclass(frozen=True, slots=True)
class SearchEnvironment:
    """The absolute folders (they need not exist). `robot` names a folder in `robots/`."""

    working_folder: Path
    config_home: Path
    data_home: Path
    config_dirs: tuple[Path, ...]
    data_dirs: tuple[Path, ...]
    robot: str = DEFAULT_ROBOT

    @property
    def roots(self) -> tuple[Root, ...]:
        """All roots in search order, without those of drop-in files."""
        roots = [Root(self.working_folder, Origin.WORKING)]
        roots += [Root(home, Origin.USER) for home in (self.config_home, self.data_home)]
        roots += [
            Root(config_dir, Origin.INSTALLED)
            for config_dir in (*self.config_dirs, *self.data_dirs)
        ]
        return tuple(roots)

    @property
    def drop_in_folders(self) -> tuple[Path, ...]:
        """Folders of drop-in files, those of the user first."""
        homes = (self.config_home, self.data_home, *self.config_dirs, *self.data_dirs)
        return tuple(dict.fromkeys(home / "path.d" for home in homes))

    @classmethod
    def from_environ(
        cls, environment: Mapping[str, str] = os.environ, working: Path | None = None
    ) -> SearchEnvironment:
        """From the variables `ROBOCOMP_*`; the XDG base directories are the defaults."""
        from platformdirs import PlatformDirs  # noqa: PLC0415 - only a search needs it

        usual = PlatformDirs(APP, appauthor=False, multipath=True)
        here = (working or Path.cwd()).absolute()

        def paths(variable: str, defaults: Iterable[str]) -> tuple[Path, ...]:
            names = [name for name in environment.get(variable, "").split(os.pathsep) if name]
            return tuple(dict.fromkeys(here / Path(n).expanduser() for n in names or defaults))

        own = os.path.join(sys.prefix, "share", APP)  # noqa: PTH118 - one of a list of strings
        return cls(
            working_folder=here,
            config_home=paths("ROBOCOMP_CONFIG_HOME", [usual.user_config_dir])[0],
            data_home=paths("ROBOCOMP_DATA_HOME", [usual.user_data_dir])[0],
            config_dirs=paths("ROBOCOMP_CONFIG_DIRS", usual.site_config_dir.split(os.pathsep)),
            data_dirs=paths("ROBOCOMP_DATA_DIRS", [*usual.site_data_dir.split(os.pathsep), own]),
            robot=environment.get("ROBOCOMP_ROBOT_NAME") or DEFAULT_ROBOT,
        )

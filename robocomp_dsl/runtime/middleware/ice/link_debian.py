"""Makes Debian's package `python3-zeroc-ice` usable in a virtual environment.

Run it with the Python of the environment:
`python -m robocomp_dsl.runtime.middleware.ice.link_debian`. It links the packages of Ice, and no
others, from the system's folder into the environment. Debian compiles them for its own version
of Python, which must be that of the environment.
"""

from __future__ import annotations

import sys
import sysconfig
from importlib.util import find_spec
from pathlib import Path

SYSTEM = Path("/usr/lib/python3/dist-packages")
PACKAGES = ("Ice", "IceBox", "IceGrid", "IceMX", "IcePatch2", "IceStorm", "Glacier2")


def link_packages(system: Path, site: Path) -> list[str]:
    """Link the packages of Ice from `system` into `site`; returns their names.

    Raises `FileNotFoundError` with a message if they are not there, or for another Python.
    """
    library = f"IcePy{sysconfig.get_config_var('EXT_SUFFIX')}"
    if not (system / library).exists():
        built = ", ".join(path.name for path in system.glob("IcePy*.so"))
        raise FileNotFoundError(
            f"Debian's Ice is for another Python: {built}, not {library}"
            if built
            else f"there is no Ice in {system}; run: sudo apt-get install python3-zeroc-ice"
        )
    names = [name for name in PACKAGES if (system / name).is_dir()]
    for name in (*names, library):
        link = site / name
        if not link.exists():
            link.unlink(missing_ok=True)
            link.symlink_to(system / name)
    return names


def main() -> int:
    """Link the packages, unless Ice can be imported already; returns the exit code."""
    if find_spec("Ice"):
        return 0
    try:
        names = link_packages(SYSTEM, Path(sysconfig.get_path("platlib")))
    except OSError as error:
        sys.stderr.write(f"{error}\n")
        return 1
    sys.stdout.write(f"linked {', '.join(names)}\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())

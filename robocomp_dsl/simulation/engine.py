"""The physics engine, MuJoCo: loaded once; its warnings go to the logger `robocomp.mujoco`.

By default MuJoCo writes its warnings to a file in the working folder. `connect` runs when the
package is imported, before any of its modules uses the engine.
"""

from __future__ import annotations

import logging

from robocomp_dsl.extras import MissingExtra


def connect() -> None:
    """Load MuJoCo and redirect its warnings. Raises `MissingExtra`.

    It must run before the first model is compiled.
    """
    try:
        import mujoco  # noqa: PLC0415 - its absence is explained
    except ModuleNotFoundError as error:
        raise MissingExtra("the simulation of devices", "simulation", error) from None
    mujoco.set_mju_user_warning(logging.getLogger("robocomp.mujoco").warning)

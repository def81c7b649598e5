"""Simulated drivers on MuJoCo. Importing this package needs the extra `simulation`.

MuJoCo counts in m with z up, a right-handed frame; `axes` holds the only conversion. Its warnings
go to the logger `robocomp.mujoco`; on its own it would write a file into the working folder.
"""

import logging

try:
    import mujoco as _engine
except ImportError as missing:
    raise ImportError(
        "simulated devices need MuJoCo: pip install 'robocomp_dsl[simulation]'"
    ) from missing

_engine.set_mju_user_warning(logging.getLogger("robocomp.mujoco").warning)

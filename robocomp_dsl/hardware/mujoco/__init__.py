"""Simulated drivers on MuJoCo. Importing this package needs the extra `simulation`.

MuJoCo counts in m with z up, a right-handed frame; `axes` holds the only conversion.
"""

try:
    import mujoco as _engine  # noqa: F401  tells early, in words, that it is missing
except ImportError as missing:
    raise ImportError(
        "simulated devices need MuJoCo: pip install 'robocomp_dsl[simulation]'"
    ) from missing

"""Simulated devices on MuJoCo. Importing this package needs the extra `simulation`.

MuJoCo uses metres, with z up, in a right-handed frame; `scene/axes.py` holds the only conversion.
"""

from robocomp_dsl.simulation.engine import connect

connect()

"""Base motions that several tests use."""

from __future__ import annotations

import numpy as np

THETA = np.array([-0.2, 0.3, 0.0, 0.5, 0.0])

OTHER = np.array([0.1, 0.0, 0.4, 0.0, 0.0])

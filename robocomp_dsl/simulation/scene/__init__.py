"""From a scene to a MuJoCo model."""

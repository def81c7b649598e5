"""Components for real devices: `driver_component` describes one, `skeleton` writes its driver."""

"""InnerModel worlds and skin as plain data for the simulation."""

"""inproc: components of one process call each other directly."""

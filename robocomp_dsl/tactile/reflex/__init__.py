"""The withdrawal reflex: receptive fields, the force and distance law, and when it may act."""

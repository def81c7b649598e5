"""The simulated world: physics, state, nodes and the devices in it."""

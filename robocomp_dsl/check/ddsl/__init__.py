"""DDSL: the instances of a deployment, their settings, connections, order and devices."""

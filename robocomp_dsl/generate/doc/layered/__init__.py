"""Layered graph layout (Sugiyama): ranks, order, coordinates, routes. `layout` starts it."""

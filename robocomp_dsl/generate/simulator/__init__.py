"""Simulator components: `simulator` describes one from a world."""

"""Skin: taxels on limbs, their cone model, touches, sensor values."""

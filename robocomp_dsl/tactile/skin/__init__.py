"""Skin in space: taxels on limbs, the cone that stands for them, touches, sensor values."""

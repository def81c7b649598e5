"""A robot's generic parts and skin as data: files in, checked dataclasses out."""

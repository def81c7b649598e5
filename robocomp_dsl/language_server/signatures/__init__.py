"""Resolved objects as a few lines of their own language, for hover and completion."""

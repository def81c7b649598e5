"""IDSL: types, operations and their patterns."""

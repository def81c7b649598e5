"""Symbols and their occurrences: `index` answers most features, one reader per language."""

"""Name lookup: import scopes, duplicates, and suggestions for unknown names."""

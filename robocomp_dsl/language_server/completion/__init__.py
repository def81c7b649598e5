"""Completion: the context of the cursor, and the candidates of each language."""

"""The nodes of the syntax trees, one module per language."""

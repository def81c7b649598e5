"""The files of a run: sources, imports and what was loaded from them."""

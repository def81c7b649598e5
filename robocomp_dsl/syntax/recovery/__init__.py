"""Error recovery: what happens after a syntax error."""

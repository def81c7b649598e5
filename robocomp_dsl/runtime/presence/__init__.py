"""The presence plane: which ports and components exist in a domain, in which state, and where."""

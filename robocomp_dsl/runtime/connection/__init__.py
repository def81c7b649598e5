"""The connection plane: ports of a component, selection of peers, counts, execution, failures."""

"""Commands that look into a running deployment, and act on it, through the schema of components."""

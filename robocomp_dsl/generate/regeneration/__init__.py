"""Updates of the user's files after a description has changed. `update` starts it."""

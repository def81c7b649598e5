"""Updates the user's files after a description has changed; `update` is the entry point."""

"""Incremental parsing for the language server."""

"""Formatter of all languages; `formatter` is the entry."""

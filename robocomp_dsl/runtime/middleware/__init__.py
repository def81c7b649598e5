"""Middlewares: `base` defines the protocols, `registry` opens a middleware by name."""

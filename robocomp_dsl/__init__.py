"""robocomp_dsl: describe robot components in small languages, generate, run and deploy them."""

__version__ = "0.1.0"

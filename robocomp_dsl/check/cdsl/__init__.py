"""CDSL: the component, its ports, options and middlewares."""

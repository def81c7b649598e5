"""The router of one host: `python -m robocomp_dsl.runtime.router SETTINGS.json`."""

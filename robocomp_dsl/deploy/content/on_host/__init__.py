"""Modules that rcdeploy sends to a host and runs there: standard library only.

`dispatch.py` reads requests; `files.py`, `environments.py` and `garbage.py` answer them. Each is
sent as source text and run in one namespace, so they do not import each other.
"""

"""The resolved nouns that checks judge, templates print, editors show and deployments run.

Frozen data without I/O. Types, interfaces and components compare by identity: one declaration is
one object, however many files mention it.
"""

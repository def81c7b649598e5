"""Syntax highlighting of the languages: keyword tables, rules, and a Pygments lexer.

All editors use the same rules; the files in `editors/` are generated from them.
"""

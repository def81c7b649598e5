"""Colours for the languages: the words and where they stand, rules over them, a Pygments lexer.

The rules are the same for every editor; the files under `editors/` are written from them.
"""

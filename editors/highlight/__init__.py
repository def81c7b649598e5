"""Highlighting for every editor from one table of keywords, generated from the grammars.

`python -m editors.highlight` writes `grammars/words.json`,
and from it the syntax files of each editor.
"""

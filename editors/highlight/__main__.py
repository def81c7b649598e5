"""Writes the table of keywords and the files generated from it: `python -m editors.highlight`."""

from __future__ import annotations

from editors.highlight.files import ROOT, files, table_file


def main() -> None:
    """Writes the table first, since the other files are generated from it."""
    for outputs in (table_file, files):
        for path, text in outputs().items():
            target = ROOT / path
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()

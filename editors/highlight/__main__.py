"""Writes the table of words and every file that is made from it: `python -m editors.highlight`."""

from __future__ import annotations

from editors.highlight.files import ROOT, files, table_file


def main() -> None:
    """First the table, since the other files are made from the written one."""
    for outputs in (table_file, files):
        for path, text in outputs().items():
            target = ROOT / path
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()

"""Writes data as YAML: keys in the given order, texts quoted where YAML 1.1 needs it. Pure."""

from __future__ import annotations

from typing import Any

import yaml


class _Dumper(yaml.SafeDumper):
    """Without anchors: every mapping is written in full."""

    def ignore_aliases(self, data: Any) -> bool:  # noqa: ARG002 - the signature is PyYAML's
        return True


def _write_text(dumper: yaml.SafeDumper, text: str) -> yaml.ScalarNode:
    """Lines as lines, unless YAML would lose blanks at their ends."""
    is_block = "\n" in text and not any(line != line.rstrip() for line in text.split("\n"))
    style = "|" if is_block else None
    return dumper.represent_scalar("tag:yaml.org,2002:str", text, style=style)


_Dumper.add_representer(str, _write_text)


def to_yaml(*documents: dict[str, Any]) -> str:
    """The documents of one file."""
    text: str = yaml.dump_all(
        documents,
        Dumper=_Dumper,
        sort_keys=False,
        allow_unicode=True,
        width=100,
        default_flow_style=False,
        explicit_start=len(documents) > 1,
    )
    return text

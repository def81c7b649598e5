"""Where an imported interface description is looked for.

In: the name written in an import and the file that it stands in. Out: a path inside one of the
folders, in this order: beside the file, the `-I` folders, those of `ROBOCOMP_INTERFACES`, the
shipped interfaces. Only the last part of a written path counts, so no import leaves the folders.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from robocomp_dsl.check.files import Files
from robocomp_dsl.diagnostics import nearest
from robocomp_dsl.source import Source, UnreadableSource

VARIABLE = "ROBOCOMP_INTERFACES"
SUFFIX = ".idsl"
_DECLARED = re.compile(
    r"\b(?:interface|struct|enum|exception)\s+([A-Za-z_]\w*)|>\s*([A-Za-z_]\w*)\s*;"
)


def base_name(written: str) -> str:
    """The last part of a path as people wrote it on any system."""
    return re.split(r"[\\/]", written)[-1]


class Search:
    """The folders of one run, and what is found in them."""

    def __init__(
        self, files: Files, folders: Iterable[Path], environ: Mapping[str, str], shipped: Path
    ) -> None:
        self._files = files
        listed = (Path(one) for one in environ.get(VARIABLE, "").split(os.pathsep) if one)
        self._everywhere = (*folders, *listed, shipped)
        self._declared: dict[Path, tuple[Source, frozenset[str]]] = {}
        self._importable: tuple[Path, list[Path]] | None = None

    def folders(self, root: Path) -> Sequence[Path]:
        """Where an import in the checked file `root` is looked for, first to last, none twice."""
        return list(dict.fromkeys((root.parent, *self._everywhere)))

    def find(self, name: str, root: Path) -> Path | None:
        """The first file called `name`, or None."""
        for folder in self.folders(root):
            path = folder / name
            if self._files.exists(path):
                return path
        return None

    def known(self, root: Path) -> list[str]:
        """Names of all files that could be imported, for completion and for guesses."""
        names = (n for folder in self.folders(root) for n in self._files.names_in(folder))
        return list(dict.fromkeys(n for n in names if n.lower().endswith(SUFFIX)))

    def guess(self, name: str, root: Path) -> str | None:
        """The file that a wrong `name` most likely means."""
        known = {one[: -len(SUFFIX)]: one for one in self.known(root) if one != root.name}
        stem = nearest(name.removesuffix(SUFFIX), known)
        return known[stem] if stem else None

    def mentioning(self, name: str, root: Path) -> list[Path]:
        """The importable files that seem to declare `name`.

        Files are only scanned for words, comments included, not parsed: see `suggest`.
        """
        if self._importable is None or self._importable[0] != root:
            paths = (self.find(known, root) for known in self.known(root))
            self._importable = (root, [path for path in paths if path is not None])
        return [path for path in self._importable[1] if name in self._words_of(path)]

    def begin(self) -> None:
        """Look into the folders again; within one run they are taken to stay as they are."""
        self._importable = None

    def _words_of(self, path: Path) -> frozenset[str]:
        try:
            source = self._files.read(path)
        except UnreadableSource:
            return frozenset()
        kept = self._declared.get(path)
        if kept is None or kept[0] is not source:
            kept = (source, frozenset(a or b for a, b in _DECLARED.findall(source.text)))
            self._declared[path] = kept
        return kept[1]

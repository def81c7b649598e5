"""Drop-in files: how a package that is installed elsewhere adds its folders to the search.

In: the `path.d` folders. Out: the folders that their files list, and what is wrong with them. A
`.conf` has a folder a line, `#` begins a comment; a `.yaml` has a list under the key `path`.
Relative folders are relative to the file; folders that are found in this way may not add others.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from robocomp_dsl.runtime.config.surroundings import Origin, Root, Surroundings
from robocomp_dsl.runtime.parameters.findings import Finding, Place, Text
from robocomp_dsl.runtime.parameters.load import Unreadable, decoded

SUFFIXES = (".conf", ".yaml")
WAY_OUT = "a .conf has a folder in each line; a .yaml has `path: [FOLDER, ...]`"


def dropped(around: Surroundings, findings: list[Finding]) -> tuple[Root, ...]:
    """The folders that drop-in files add. Adds what is wrong with a file; the others count."""
    made = [one for file in _files(around.drop_in_folders) for one in _folders(file, findings)]
    known = {root.folder for root in around.roots}
    return tuple(Root(one, Origin.DROPPED) for one in dict.fromkeys(made) if one not in known)


def _files(folders: Iterable[Path]) -> list[Path]:
    """In the order of their names in each folder; a file of the user shadows those of its name."""
    found: dict[str, Path] = {}
    for folder in folders:
        try:
            names = sorted(one for one in folder.iterdir() if one.suffix in SUFFIXES)
        except OSError:
            continue
        for one in names:
            found.setdefault(one.name, one)
    return list(found.values())


def _folders(file: Path, findings: list[Finding]) -> Iterator[Path]:
    try:
        source = decoded(file)
    except Unreadable as error:
        place = Place(Text(str(file), ()), 1, 1)
        findings.append(Finding(place, f"this drop-in file cannot be used: {error}"))
        return
    text = Text(str(file), tuple(source.splitlines()))
    said = _conf(text) if file.suffix == ".conf" else _yaml(text, source, findings)
    for place, folder in said:
        try:
            yield (file.parent / Path(folder).expanduser()).absolute()
        except RuntimeError:  # of a user who is not there
            findings.append(Finding(place, f"`{folder}` is no folder of this machine"))


def _conf(text: Text) -> Iterator[tuple[Place, str]]:
    for number, line in enumerate(text.lines, 1):
        said = line.partition("#")[0].strip()
        if said:
            yield Place(text, number, line.index(said) + 1, len(said)), said


def _yaml(text: Text, source: str, findings: list[Finding]) -> Iterator[tuple[Place, str]]:
    from robocomp_dsl.runtime.parameters.tree import Items, Scalar  # noqa: PLC0415 - for .yaml only
    from robocomp_dsl.runtime.parameters.yaml_text import read_yaml  # noqa: PLC0415 - slow to load

    root = read_yaml(text, source, findings)
    for key, member in root.members.items() if root else ():
        listed = member.value
        if key != "path" or not isinstance(listed, Items):
            findings.append(Finding(member.place, f"`{key:.80}` is no list `path`", help=WAY_OUT))
            continue
        for one in listed.items:
            if isinstance(one, Scalar) and one.text:
                yield one.place, one.text
            else:
                findings.append(Finding(one.place, "this is no folder", help=WAY_OUT))

"""Reads drop-in files, with which installed packages add folders to the search.

In: the `path.d` folders. Out: the folders that their files list, and findings. A `.conf` file has
one folder per line, `#` starts a comment; a `.yaml` file has a list under the key `path`. Relative
folders are relative to the file. Folders added in this way cannot add others.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path

from robocomp_dsl.finding import Finding, Location, SourceText
from robocomp_dsl.runtime.config.search_environment import Origin, Root, SearchEnvironment
from robocomp_dsl.runtime.parameters.load import UnreadableFile, read_text

SUFFIXES = (".conf", ".yaml")
FORMAT_HELP = "a .conf file has one folder per line; a .yaml file has `path: [FOLDER, ...]`"


def drop_in_roots(environment: SearchEnvironment, findings: list[Finding]) -> tuple[Root, ...]:
    """The folders that drop-in files add. Errors go to `findings`; valid entries are used."""
    files = _files(environment.drop_in_folders)
    folders = dict.fromkeys(folder for file in files for folder in _folders(file, findings))
    known = {root.folder for root in environment.roots}
    return tuple(Root(folder, Origin.DROP_IN) for folder in folders if folder not in known)


def _files(folders: Iterable[Path]) -> list[Path]:
    """The drop-in files, by name in each folder; a user's file overrides one of the same name."""
    found: dict[str, Path] = {}
    for folder in folders:
        try:
            names = sorted(path for path in folder.iterdir() if path.suffix in SUFFIXES)
        except OSError:
            continue
        for name in names:
            found.setdefault(name.name, name)
    return list(found.values())


def _folders(file: Path, findings: list[Finding]) -> Iterator[Path]:
    try:
        source = read_text(file)
    except UnreadableFile as error:
        place = Location(SourceText(str(file), ()), 1, 1)
        findings.append(Finding(place, f"unreadable drop-in file: {error}"))
        return
    text = SourceText.of_text(file, source)
    entries = (
        _conf_folders(text) if file.suffix == ".conf" else _yaml_folders(text, source, findings)
    )
    for place, folder in entries:
        try:
            yield (file.parent / Path(folder).expanduser()).absolute()
        except RuntimeError:  # the home folder of an unknown user
            findings.append(Finding(place, f"`{folder}` is not a folder of this machine"))


def _conf_folders(text: SourceText) -> Iterator[tuple[Location, str]]:
    for number, line in enumerate(text.lines, 1):
        folder = line.partition("#")[0].strip()
        if folder:
            yield Location(text, number, line.index(folder) + 1, len(folder)), folder


def _yaml_folders(
    text: SourceText, source: str, findings: list[Finding]
) -> Iterator[tuple[Location, str]]:
    from robocomp_dsl.runtime.parameters.tree import Items, Scalar  # noqa: PLC0415 - for .yaml only
    from robocomp_dsl.runtime.parameters.yaml_text import read_yaml  # noqa: PLC0415 - slow to load

    root = read_yaml(text, source, findings)
    for key, member in root.members.items() if root else ():
        listed = member.value
        if key != "path" or not isinstance(listed, Items):
            findings.append(
                Finding(member.place, f"`{key:.80}` is not a list `path`", help=FORMAT_HELP)
            )
            continue
        for item in listed.items:
            if isinstance(item, Scalar) and item.text:
                yield item.place, item.text
            else:
                findings.append(Finding(item.place, "not a folder", help=FORMAT_HELP))

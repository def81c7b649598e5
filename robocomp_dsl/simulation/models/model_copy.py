"""A model file as a text that is independent of its folder.

In: the path of a file in MJCF or URDF. Out: its text, with included files inserted and absolute
paths of all others.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from pathlib import Path
from xml.sax.saxutils import quoteattr, unescape

from robocomp_dsl.hardware.description.findings import ModelFileError
from robocomp_dsl.hardware.description.model_kind import root_tag
from robocomp_dsl.hardware.description.model_paths import resolve
from robocomp_dsl.regular_file import read_bytes

_TAGS = re.compile(r"<!--.*?-->|<!\[CDATA\[.*?\]\]>|<\?.*?\?>|<[^<>]*>", re.DOTALL)
_NAME = re.compile(r"</?\s*([\w.:-]+)")
_ATTRIBUTE = re.compile(r"""([\w.:-]+)(\s*=\s*)("[^"]*"|'[^']*')""")
_FOLDERS = {"mesh": "meshdir", "hfield": "meshdir", "skin": "meshdir", "texture": "texturedir"}
_CUBE = ("right", "left", "up", "down", "front", "back")
_FILES = {"file", "filename", *(f"file{side}" for side in _CUBE)}
_DEEPEST = 30
_WHOLE = re.compile(r"\A.*?<\s*(mujocoinclude|mujoco)\b[^>]*>(.*)</\s*\1\s*>.*\Z", re.DOTALL)


def copy_model(path: Path, packages: Sequence[Path] = ()) -> str:
    """The relocatable text. Raises `ModelFileError`, `OSError`."""
    text = _read(path)
    kind = root_tag(text.encode())
    if kind == "mujoco":
        text = _included(text, path, path, ())
    folders = _folders(text)

    def moved(name: str, attribute: str, value: str) -> str | None:
        if name == "compiler" and attribute == "strippath":
            return None
        if attribute not in _FILES or (kind == "mujoco" and not value):
            return value
        if "://" in value:
            return str(resolve(value, path, packages).absolute())
        if folders.get("strippath") == "true":
            value = re.split(r"[/\\]", value)[-1]
        folder = folders.get(_FOLDERS.get(name, ""), "") if kind == "mujoco" else ""
        return str(resolve(str(Path(folder) / value), path, packages).absolute())

    return _changed(text, moved)


def _read(path: Path) -> str:
    data = read_bytes(path)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def _included(text: str, main: Path, here: Path, above: tuple[Path, ...]) -> str:
    """MJCF with each `<include file="…"/>` replaced by the content of the file."""

    def written(found: re.Match[str]) -> str:
        tag = found[0]
        if _tag(tag) != "include" or tag.startswith("</"):
            return tag
        path = _values(tag).get("file", "")
        beside = [folder / path for folder in (here.parent, main.parent)]
        file = next((candidate for candidate in beside if candidate.is_file()), beside[-1])
        if file in above or len(above) > _DEEPEST:
            raise ModelFileError(f"`{path}` includes itself")
        inner = _WHOLE.match(_read(file))
        if inner is None:
            raise ModelFileError(f"`{path}` holds no `<mujoco>` that could be included")
        return _included(inner[2], main, file, (*above, file))

    return re.sub(r"</\s*include\s*>", "", _TAGS.sub(written, text))


def _folders(text: str) -> dict[str, str]:
    """The folders of MJCF's meshes and textures."""
    found: dict[str, str] = {}
    for tag in _TAGS.findall(text):
        if _tag(tag) == "compiler":
            found |= _values(tag)
    both = found.get("assetdir", "")
    return {"meshdir": both, "texturedir": both} | found


def _changed(text: str, moved: Callable[[str, str, str], str | None]) -> str:
    def rewrite(found: re.Match[str]) -> str:
        tag = found[0]
        name = _tag(tag)
        if not name or tag.startswith("</"):
            return tag

        def attribute(part: re.Match[str]) -> str:
            value = unescape(part[3][1:-1], {"&quot;": '"', "&apos;": "'"})
            now = moved(name, part[1], value)
            if now is None:
                return ""
            return part[0] if now == value else f"{part[1]}{part[2]}{quoteattr(now)}"

        return _ATTRIBUTE.sub(attribute, tag)

    return _TAGS.sub(rewrite, text)


def _tag(tag: str) -> str:
    found = _NAME.match(tag)
    return found[1] if found else ""


def _values(tag: str) -> dict[str, str]:
    pairs = _ATTRIBUTE.findall(tag)
    return {name: unescape(value[1:-1], {"&quot;": '"'}) for name, _, value in pairs}

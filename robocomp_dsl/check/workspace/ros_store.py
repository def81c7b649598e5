"""The ROS definitions inside the library rosbags, for machines without ROS.

In: the name of a definition. Out: a file in the user's cache, so that editors can open it, or a
virtual file with the same path if the cache is not writable. Without rosbags (the extra `ros`)
there are no definitions. rosbags has messages only, without comments and defaults.
"""

from __future__ import annotations

import os
import tempfile
from contextlib import suppress
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from robocomp_dsl.check.workspace.source_cache import SourceCache

DISTRIBUTION = "kilted"
"""The ROS 2 distribution whose definitions are used."""


def is_available() -> bool:
    """Whether rosbags is installed."""
    return _typestore() is not None


def names() -> list[str]:
    """The names of all definitions, `std_msgs/msg/String.msg`."""
    store = _typestore()
    return [f"{name}.msg" for name in sorted(store.fielddefs)] if store else []


def definition(name: str, files: SourceCache) -> Path | None:
    """The path of a definition; None if there is none with this name."""
    folder = _folder()
    if folder is None:
        return None
    path = folder / name
    if files.exists(path):  # copied before: no need to load rosbags
        return path
    store = _typestore()
    message = name.removesuffix(".msg")
    if store is None or message not in store.fielddefs:
        return None
    text = _text(store, message)
    with suppress(OSError):
        _write(path, text)
    if not files.exists(path):
        files.set_virtual(path, text)
    return path


def _text(store: Any, message: str) -> str:
    """The text of one message; rosbags appends those of the messages that it uses."""
    whole = str(store.generate_msgdef(message, ros_version=2)[0])
    return whole.partition("=" * 80)[0]


def _folder() -> Path | None:
    """The folder of the copies; None without rosbags."""
    from platformdirs import user_cache_path  # noqa: PLC0415 - on first use

    try:
        release = version("rosbags")
    except PackageNotFoundError:
        return None
    return user_cache_path("robocomp_dsl") / f"rosbags-{release}" / DISTRIBUTION


def _write(path: Path, text: str) -> None:
    """Write a file completely or not at all: several programs may do so at once."""
    path.parent.mkdir(parents=True, exist_ok=True)
    number, name = tempfile.mkstemp(dir=path.parent, prefix=".")
    try:
        with os.fdopen(number, "w", encoding="utf-8") as stream:
            stream.write(text)
        Path(name).replace(path)
    except OSError:
        Path(name).unlink(missing_ok=True)
        raise


@cache
def _typestore() -> Any:
    try:
        from rosbags.typesys import Stores, get_typestore  # noqa: PLC0415 - an optional extra
    except ImportError:
        return None
    return get_typestore(Stores.ROS2_KILTED)

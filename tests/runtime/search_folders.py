"""Folders of a configuration search below `tmp_path`: working, user and two installed folders."""

from __future__ import annotations

from pathlib import Path

FOLDERS = {
    "ROBOCOMP_CONFIG_HOME": "user/config",
    "ROBOCOMP_DATA_HOME": "user/data",
    "ROBOCOMP_CONFIG_DIRS": "admin",
    "ROBOCOMP_DATA_DIRS": "share1:share2",
}


class SearchFolders:
    """The folders are named as in `FOLDERS`; the working folder is `work`."""

    def __init__(self, top: Path) -> None:
        self.top = top
        self.work = top / "work"
        self.work.mkdir()
        self.environment = {
            name: ":".join(str(top / folder) for folder in folders.split(":"))
            for name, folders in FOLDERS.items()
        }

    def put(self, path: str, text: str = "rate: 1\n") -> Path:
        file = self.top / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        return file

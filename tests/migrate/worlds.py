"""Old components of our own, as folders."""

from __future__ import annotations

from pathlib import Path

HEAD = """from PySide2.QtCore import QTimer
from genericworker import *

class SpecificWorker(GenericWorker):
    def __init__(self, proxy_map, startup_check=False):
        super(SpecificWorker, self).__init__(proxy_map)
        self.Period = 20
        self.timer.timeout.connect(self.compute)
        self.timer.start(self.Period)

"""
"""The beginning of a worker whose `compute` the caller appends."""


def write_component(folder: Path, files: dict[str, str], ports: str = "") -> Path:
    """A component folder with these files; the CDSL has `ports` and imports their interfaces."""
    name = folder.name
    imports = "".join(
        f'import "{interface.strip(" ,;")}.idsl";\n' for interface in ports.split()[1:]
    )
    cdsl = f"{imports}Component {name} {{ Communications {{ {ports} }}; language python; }};\n"
    for path, text in ({f"{name}.cdsl": cdsl} | files).items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text)
    return folder

"""The `<custom>` texts of a model file, as words by name."""

from __future__ import annotations

from typing import Any

import mujoco


def texts_of(model: Any) -> dict[str, list[str]]:
    """All texts, in file order."""
    found: dict[str, list[str]] = {}
    for i in range(model.ntext):
        first, size = int(model.text_adr[i]), int(model.text_size[i])
        text = bytes(model.text_data[first : first + size]).rstrip(b"\0")
        name = str(mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_TEXT, i))
        found[name] = text.decode("utf-8", "replace").split()
    return found

"""A simulator from a world: the descriptions of a component, and the code that serves its devices.

In: a resolved `Body`, or a model file as the data of a scene; later the `Component` that the
descriptions resolve to. Out: texts and `OutputFile`s. The scene goes as data into `scene.json` in
the generated package, a model file beside it; `robocomp_dsl.simulation` simulates them.
"""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from robocomp_dsl.generate.literals import markdown_cell
from robocomp_dsl.generate.names import camel
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.plan import plan
from robocomp_dsl.generate.python.component_names import names_of
from robocomp_dsl.generate.scene.scene import lower_body, unique_name
from robocomp_dsl.generate.scene.scene_files import resolve_files
from robocomp_dsl.generate.simulator.handlers import SKIN, simulator_code
from robocomp_dsl.generate.simulator.served_interfaces import (
    BOARDS,
    CLOCK,
    DEFAULT_RATE,
    Published,
    ServedAs,
    identifier,
    not_served,
    period_of,
    published,
    served,
    skin_rate,
)
from robocomp_dsl.generate.templates import render
from robocomp_dsl.hardware.description.world_files import FileSearch
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.innermodel import InnerModel

_NUMBERS = re.compile(r"\[\n\s*(-?[\d.][^\[\]{}\"]*?)\n\s*\]")
"""A list of numbers, each on a line of its own."""

FOLDER = "python/simulator/"
WORKER = "specificworker.py"
README = "README.md"
_MOST_NAMED = 8
LEAST_STEP, MOST_STEP = 0.05, 20.0  # ms, as the PDSL has it


@dataclass(frozen=True, slots=True)
class Simulator:
    """The simulator of a world: the `scene` as data, its `ports`, and devices without a port.

    `model` is the text of the model file on which the scene is based; `step` is in ms.
    """

    name: str
    source: str
    scene: dict[str, Any]
    ports: tuple[ServedAs, ...]
    topics: tuple[Published, ...]
    unserved: tuple[tuple[str, str], ...]
    skin_rate: float = 0.0
    model: str = ""
    step: float = 2.0
    also: tuple[str, ...] = ()

    @property
    def step_told(self) -> str:
        """The length of a step as written in the PDSL file."""
        return f"{self.step:g}"

    @property
    def title(self) -> str:
        """The name in CamelCase, as the first part of class names."""
        return camel(self.name)

    @property
    def pushed(self) -> bool:
        """Whether the world has joints with streamed references."""
        return any(port.interface == BOARDS for port in self.ports)


def simulator(body: InnerModel, files: Sequence[Path] = ()) -> Simulator:
    """The simulator of a world; its meshes and pictures are searched in `files`, too.

    File names in the scene become absolute paths.
    """
    scene = lower_body(body)
    resolve_files(scene, FileSearch(body.path.parent, files))
    return _simulator(body.path, scene)


def simulator_of_model(
    path: Path, scene: dict[str, Any], model: str, *, step: float = 0.002
) -> Simulator:
    """The simulator of the model file at `path`; its text is stored as `model`; `step` is in s."""
    return _simulator(path, scene, model, min(max(round(step * 1000, 6), LEAST_STEP), MOST_STEP))


def with_skin(simulator: Simulator, skin: dict[str, Any]) -> Simulator:
    """The same world with an additional skin, lowered by `generate.skin`; nodes get free names."""
    taken = {
        node["id"]
        for nodes in ("frames", "boxes", "meshes", "devices")
        for node in simulator.scene[nodes]
    }
    patches = [node | {"name": unique_name(node["name"], taken)} for node in skin["patches"]]
    skin = skin | {"id": unique_name(skin["id"], taken), "patches": patches}
    body = skin["limbs"][0]["body"]
    device = {"id": skin["id"], "kind": SKIN, "frame": body, "settings": {"rate": DEFAULT_RATE}}
    scene = simulator.scene | {
        "devices": [*simulator.scene["devices"], device],
        "skins": [*simulator.scene.get("skins", ()), skin],
    }
    return _serving(simulator, scene, simulator.also)


def serving_also(simulator: Simulator, also: Sequence[str]) -> Simulator:
    """The same world with further opt-in interfaces (`served_interfaces.OPT_IN`)."""
    return _serving(simulator, simulator.scene, tuple(also))


def _serving(simulator: Simulator, scene: dict[str, Any], also: tuple[str, ...]) -> Simulator:
    ports = served(scene, also)
    return replace(
        simulator,
        scene=scene,
        ports=ports,
        topics=published(ports),
        unserved=tuple(not_served(scene)),
        skin_rate=skin_rate(scene),
        also=also,
    )


def _simulator(path: Path, scene: dict[str, Any], model: str = "", step: float = 2.0) -> Simulator:
    name = f"{identifier(path.stem)}_simulator"
    bare = Simulator(name, path.name, scene, (), (), (), model=model, step=step)
    return _serving(bare, scene, ())


def descriptions(simulator: Simulator) -> list[OutputFile]:
    """The CDSL and the PDSL file."""
    imports = dict.fromkeys(port.interface for port in simulator.ports)
    imports |= dict.fromkeys(topic.topic.file for topic in simulator.topics)
    imports |= {CLOCK: None}
    return [
        OutputFile(
            f"{simulator.name}.cdsl",
            render(
                f"{FOLDER}simulator.cdsl.jinja",
                simulator=simulator,
                imports=imports,
                period=period_of(simulator.topics),
            ),
        ),
        OutputFile(
            f"{simulator.name}.pdsl", render(f"{FOLDER}simulator.pdsl.jinja", simulator=simulator)
        ),
    ]


def files(simulator: Simulator, component: Component) -> list[OutputFile]:
    """All files of the component except its descriptions."""
    py_names = names_of(component)
    code, package = (
        simulator_code(simulator.source, component, py_names, simulator.topics),
        py_names.package,
    )
    return [
        *(file for file in plan(component) if file.path not in (WORKER, README)),
        OutputFile(
            README,
            render(f"{FOLDER}{README}.jinja", simulator=simulator, rows=rows(simulator.ports)),
            write_once=True,
        ),
        *world_files(simulator, package),
        OutputFile(f"{package}/simulator.py", render(f"{FOLDER}simulator.py.jinja", code=code)),
        OutputFile(WORKER, render(f"{FOLDER}{WORKER}.jinja", code=code), write_once=True),
    ]


def rows(ports: Sequence[ServedAs]) -> list[tuple[str, str, str]]:
    """Port, interface and devices, for Markdown."""
    return [
        (
            markdown_cell(port.port),
            port.interface,
            markdown_cell(_named([id_ for id_, _ in port.devices])),
        )
        for port in ports
    ]


def _named(ids: Sequence[str]) -> str:
    """At most as many names as fit."""
    if not ids:
        return "the world"
    more = f" and {len(ids) - _MOST_NAMED} more" if len(ids) > _MOST_NAMED else ""
    return ", ".join(ids[:_MOST_NAMED]) + more


def world_files(simulator: Simulator, package: str) -> list[OutputFile]:
    """The world as data in a generated package, and its model file, if any."""
    data = {"scene": simulator.scene, "ports": {port.port: port.ids for port in simulator.ports}}
    found = [OutputFile(f"{package}/scene.json", _text(data))]
    if simulator.model:
        found.append(OutputFile(f"{package}/{simulator.scene['model']['file']}", simulator.model))
    return found


def _text(data: dict[str, Any]) -> str:
    """JSON for readers: a list of numbers is one line."""
    spread = json.dumps(data, indent=1, ensure_ascii=False)
    return _NUMBERS.sub(lambda found: f"[{' '.join(found[1].split())}]", spread) + "\n"

"""All files of a bridge.

In: a checked bridge, and later the component that its descriptions resolve to. Out: `OutputFile`s.
The descriptions come first: the component is checked from them, as `rcgen component` does.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.bridge.bridge_names import BridgeNames
from robocomp_dsl.generate.bridge.mapping import mapping_code
from robocomp_dsl.generate.bridge.specification import SpecificationCode, specification_code
from robocomp_dsl.generate.bridge.user_functions import function_methods
from robocomp_dsl.generate.bridge.wiring import BridgeWiring
from robocomp_dsl.generate.literals import lines, markdown_cell, markdown_code
from robocomp_dsl.generate.output import MANIFEST_FOLDER, OutputFile
from robocomp_dsl.generate.plan import plan
from robocomp_dsl.generate.python.component_files import parameter_row
from robocomp_dsl.generate.regeneration.methods import Method
from robocomp_dsl.generate.regeneration.update import WORKER, update_user_files
from robocomp_dsl.generate.templates import render
from robocomp_dsl.model.bridge import Bridge
from robocomp_dsl.model.bridge_ports import BridgePort
from robocomp_dsl.model.component import Component

FOLDER = "python/bridge/"
README = "README.md"
FUNCTIONS = f"{MANIFEST_FOLDER}functions.json"
"""The manifest of the user's functions; that of operations belongs to `rcgen component`."""


def bridge_files(
    folder: Path,
    bridge: Bridge,
    component: Component,
    wiring: BridgeWiring,
    report: Report,
    *,
    writes: bool = True,
) -> list[OutputFile]:
    """All files except the descriptions, with the changes of the user's files in `folder`.

    `report` gets findings about these; without `writes` they describe what would be done.
    """
    names = BridgeNames(bridge, component)
    mapping = mapping_code(bridge, names)
    code = specification_code(bridge, names, wiring, mapping)
    methods = function_methods(bridge, names)
    package = names.python.package
    generated = [
        *(file for file in plan(component) if file.path not in (WORKER, README)),
        OutputFile(f"{package}/mapping.py", render(f"{FOLDER}mapping.py.jinja", code=mapping)),
        OutputFile(
            f"{package}/bridge_worker.py", render(f"{FOLDER}bridge_worker.py.jinja", code=code)
        ),
        _worker(code, methods),
    ]
    updated = update_user_files(
        folder, component, generated, report, writes=writes, methods=methods, recorded=FUNCTIONS
    )
    return [*updated, _readme(bridge, code, component)]


def _worker(code: SpecificationCode, methods: dict[str, Method]) -> OutputFile:
    stubs = [method.code for method in methods.values()]
    types = {name for method in methods.values() for name in method.types}
    context = {
        "code": code,
        "stubs": stubs,
        "imports": sorted(types - {"rt"}),
        "uses_runtime_types": "rt" in types,
    }
    return OutputFile(WORKER, render(f"{FOLDER}{WORKER}.jinja", **context), write_once=True)


def _readme(bridge: Bridge, code: SpecificationCode, component: Component) -> OutputFile:
    parameters = component.parameters.parameters if component.parameters else ()
    rows = [
        parameter_row(member, f"{group.name}.{member.name}")
        for group in parameters
        for member in group.members
    ]
    about = ("", *found) if (found := lines(bridge.doc)) else ()
    text = render(
        f"{FOLDER}{README}.jinja",
        code=code,
        about=about,
        rows=list(_rows(bridge)),
        parameters=rows,
    )
    return OutputFile(README, text, write_once=True)


def _rows(bridge: Bridge) -> Iterator[tuple[str, str, str]]:
    kinds: Sequence[tuple[str, Sequence[tuple[str, BridgePort]]]] = (
        ("input", [(i.name, i.port) for i in bridge.inputs]),
        ("output", [(o.name, o.port) for o in bridge.outputs]),
        ("service", [(s.name, s.port) for s in bridge.services]),
        ("action", [(p.name, p) for action in bridge.actions for p in action.ports]),
        ("call", [(c.name, c.port) for s in bridge.services for c in s.calls]),
    )
    for kind, ports in kinds:
        for name, port in ports:
            address = f" {markdown_code(port.address)}" if port.address else ""
            yield kind, markdown_cell(name), f"{markdown_cell(port.middleware)}{address}"

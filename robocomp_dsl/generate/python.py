"""The target Python: a component's model to the files of its folder.

In: a `Component`. Out: `OutputFile`s; nothing is read from the disk but the templates.
"""

from __future__ import annotations

from robocomp_dsl.generate import literals, params, worker
from robocomp_dsl.generate.component_names import modules_of, names_of
from robocomp_dsl.generate.interface_code import interfaces_code
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.schema import config_schema
from robocomp_dsl.generate.templates import render
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.parameter import Parameter

FOLDER = "python/component/"


def component_files(component: Component, middleware: str) -> list[OutputFile]:
    """All files of a component."""
    called = names_of(component)
    code = worker.worker_code(component, called, middleware)
    parameters = params.params_code(called.params, component)
    modules = modules_of(component)
    interfaces = interfaces_code(
        [m.path.name for m in modules], component.ports, called.interfaces, called.types
    )
    given = component.parameters.parameters if component.parameters else ()
    config = list(params.config_lines(given))
    rows = [_row(p) for p in given]
    schema = config_schema(code.title, component.doc, given)
    return [
        _file("main.py", worker=code),
        _file("generated/__init__.py", "generated_init.py", worker=code),
        _file("generated/interfaces.py", code=interfaces),
        _file("generated/params.py", code=parameters),
        _file("generated/genericworker.py", worker=code),
        *([_file("generated/machine.py", machine=code.machine)] if code.machine else []),
        OutputFile("etc/config.schema.json", schema),
        _file("specificworker.py", keep=True, worker=code),
        _file("etc/config.yaml", "config.yaml", keep=True, title=code.title, lines=config),
        _file("README.md", keep=True, worker=code, parameters=rows),
    ]


def _row(one: Parameter) -> tuple[str, str, str, str]:
    """A row of the table in the README."""
    default = "" if one.default is None else literals.yaml_value(one.default)
    about = (params.takes(one), literals.sentence(one.doc))
    takes, what = map(literals.markdown_cell, about)
    return literals.markdown_cell(one.name), literals.markdown_code(default), takes, what


def _file(path: str, template: str = "", *, keep: bool = False, **context: object) -> OutputFile:
    name = template or path.rpartition("/")[2]
    return OutputFile(path, render(f"{FOLDER}{name}.jinja", **context), keep)

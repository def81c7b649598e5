"""Target language Python: from a component's model to the files of its folder.

In: a `Component`. Out: `OutputFile`s. Only the templates are read from disk.
"""

from __future__ import annotations

from robocomp_dsl.generate import literals
from robocomp_dsl.generate.exports.config_schema import config_schema
from robocomp_dsl.generate.output import OutputFile
from robocomp_dsl.generate.python import params, worker
from robocomp_dsl.generate.python.component_names import modules_of, names_of
from robocomp_dsl.generate.python.documentation import documentation
from robocomp_dsl.generate.python.interface_code import interfaces_code
from robocomp_dsl.generate.templates import render
from robocomp_dsl.model.component import Component
from robocomp_dsl.model.parameter import Parameter

FOLDER = "python/component/"


def component_files(component: Component, middleware: str) -> list[OutputFile]:
    """All files of a component."""
    py_names = names_of(component)
    code = worker.worker_code(component, py_names, middleware)
    parameters = params.params_code(py_names.params, component)
    modules = modules_of(component)
    interfaces = interfaces_code(
        component.path.name,
        [m.path.name for m in modules],
        component.ports,
        py_names.interfaces,
        py_names.types,
    )
    package = py_names.package
    parameter_list = component.parameters.parameters if component.parameters else ()
    config = list(params.config_lines(parameter_list))
    rows = [parameter_row(p, p.name) for p in parameter_list]
    schema = config_schema(code.title, component.doc, parameter_list)
    texts = documentation(py_names.interfaces, py_names.types)
    return [
        _file("main.py", worker=code),
        _file(f"{package}/__init__.py", "generated_init.py", worker=code),
        _file(f"{package}/interfaces.py", code=interfaces),
        OutputFile(f"{package}/interfaces.json", texts),
        _file(f"{package}/params.py", code=parameters),
        _file(f"{package}/genericworker.py", worker=code),
        *([_file(f"{package}/machine.py", machine=code.machine)] if code.machine else []),
        OutputFile("etc/config.schema.json", schema),
        _file("specificworker.py", write_once=True, worker=code),
        *([_file("mainUI.ui", write_once=True, worker=code)] if code.window else []),
        _file("etc/config.yaml", "config.yaml", write_once=True, title=code.title, lines=config),
        _file("README.md", write_once=True, worker=code, parameters=rows),
    ]


def parameter_row(parameter: Parameter, name: str) -> tuple[str, str, str, str]:
    """One row of the parameter table in the README; `name` is its full name."""
    default = "" if parameter.default is None else literals.yaml_value(parameter.default)
    about = (params.takes(parameter), literals.sentence(parameter.doc))
    takes, what = map(literals.markdown_cell, about)
    return literals.markdown_cell(name), literals.markdown_code(default), takes, what


def _file(
    path: str, template: str = "", *, write_once: bool = False, **context: object
) -> OutputFile:
    name = template or path.rpartition("/")[2]
    return OutputFile(path, render(f"{FOLDER}{name}.jinja", **context), write_once)

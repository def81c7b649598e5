"""Loads the class of a monitor from a Python file.

In: the settings of a monitor and the operations of its connection. Out: the class, checked against
them; or a `MonitorError` with every finding at `file:line:column`.
"""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Iterable
from hashlib import sha256
from pathlib import Path
from types import ModuleType

from robocomp_dsl.monitors.class_check import check_monitor_class
from robocomp_dsl.monitors.monitor_finding import MonitoredOperation
from robocomp_dsl.runtime.component.interface import Operation
from robocomp_dsl.runtime.component.thread_context import current_context
from robocomp_dsl.runtime.component.user_errors import add_user_folder, describe_error
from robocomp_dsl.runtime.connection.monitor import Monitor
from robocomp_dsl.runtime.connection.monitor_settings import MonitorSettings
from robocomp_dsl.runtime.data.schema import BOOL, DOUBLE, FLOAT, Primitive, Type
from robocomp_dsl.runtime.errors import MonitorError


def load_monitor_class(settings: MonitorSettings, operations: Iterable[Operation]) -> type[Monitor]:
    """The class of a monitor. Raises `MonitorError`."""
    file = settings.file.absolute()
    try:
        text = file.read_text("utf-8-sig")
    except (OSError, UnicodeDecodeError, ValueError) as error:
        raise MonitorError(f"cannot read the monitor {file}: {error}") from None
    monitored = [_operation(operation) for operation in operations]
    parameters = dict(settings.parameters)
    findings = check_monitor_class(text, settings.class_name, monitored, parameters).findings
    if findings:
        raise MonitorError(
            "\n".join(
                f"{file}:{f.line}:{f.column}: {f.message}{f'; {f.help}' if f.help else ''}"
                for f in findings
            )
        )
    cls = getattr(_load_module(file), settings.class_name, None)
    if not (isinstance(cls, type) and issubclass(cls, Monitor)):
        raise MonitorError(f"{file}: `{settings.class_name}` does not extend `Monitor`")
    return cls


def _load_module(file: Path) -> ModuleType:
    """The module of a file, loaded once for each component. Raises `MonitorError`."""
    context = current_context()
    identity = f"{file}\0{context.name}" if context else str(file)
    name = f"robocomp_monitor_{sha256(identity.encode()).hexdigest()[:16]}"
    if name in sys.modules:
        return sys.modules[name]
    folder = str(file.parent)
    if folder not in sys.path:
        sys.path.append(folder)  # last: names of the component have precedence
    spec = importlib.util.spec_from_file_location(name, file)
    if spec is None or spec.loader is None:
        raise MonitorError(f"{file} is no Python file; its name ends in .py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # dataclasses look for it
    if context:
        module.__dict__["__builtins__"] = context.builtins
    try:
        spec.loader.exec_module(module)
    except Exception as error:
        del sys.modules[name]
        raise MonitorError(f"cannot load the monitor {file}: {describe_error(error)}") from error
    classes = (value for value in vars(module).values() if isinstance(value, type))
    for cls in classes:
        if cls.__module__ == name:
            add_user_folder(cls)
            break
    return module


def _operation(operation: Operation) -> MonitoredOperation:
    inputs = tuple((name, _python_type(type_)) for name, type_ in operation.inputs)
    return MonitoredOperation(operation.name, inputs)


def _python_type(type_: Type) -> str:
    """`bool`, `int`, `float` or `str`; "" for any other type."""
    if not isinstance(type_, Primitive):
        return ""
    if type_ is BOOL:
        return "bool"
    if type_.is_text:
        return "str"
    return "float" if type_ in {FLOAT, DOUBLE} else "int"

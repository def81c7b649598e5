"""Stubs: appends the missing methods to the user's class.

In: the user's module and the methods. Out: its text with the stubs and their imports; all other
characters are unchanged. libcst locates the end of the class and the style of indentation and line
ends.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Mapping, Sequence

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate import codes
from robocomp_dsl.generate.python.layout import STEP
from robocomp_dsl.generate.regeneration.compare_signatures import similar_method
from robocomp_dsl.generate.regeneration.hierarchy import CLASS
from robocomp_dsl.generate.regeneration.methods import Method
from robocomp_dsl.generate.regeneration.python_module import Function, end_of_comments
from robocomp_dsl.generate.regeneration.user_module import UserModule, bound_names, parsed
from robocomp_dsl.record import ValueRecord
from robocomp_dsl.source import Source

RUNTIME_TYPES = ("rt", "from robocomp_dsl.runtime import types as rt")
"""The name in annotations of arrays, and the line that imports it."""
QUALIFIER = "generated_interfaces"
"""Alias of the types' module if the user uses the name of a type for something else."""


class _Class(ValueRecord):
    """End and style of the class. `open` is the offset of a body on its own line.

    `end` is the offset after the last statement; `open` is None unless the body is on the
    line of the `class`.
    """

    end: int
    open: int | None
    indent: str
    step: str
    newline: str


def added(user: UserModule, missing: Sequence[Method], package: str) -> str:
    """The text of the module with a stub for each of `missing`.

    `package` is the package of the generated code.
    """
    text = user.source.text
    found = _class(user)
    local, lines = _imports(user, missing, package)
    stubs = "".join(_stub(method, local, found) for method in missing)
    text = _after_line(text, end_of_comments(text, found.end, found.indent), stubs, found.newline)
    if found.open is not None:
        text = f"{text[: found.open]}{found.newline}{found.indent}{text[found.open :]}"
    if lines:
        more = found.newline.join([*lines, ""])
        at = _import_place(user, f"{package}.interfaces")
        text = more + text if at is None else _after_line(text, at, more, found.newline)
    return text


def report_added(
    user: UserModule,
    text: str,
    missing: Sequence[Method],
    methods: Mapping[str, Method],
    report: Report,
) -> None:
    """Report the stubs, at their new positions."""
    source = Source(user.source.path, text)
    places = _places(source)
    name = user.worker.name if user.worker else CLASS
    for method in missing:
        at = places[method.name]
        report.add(
            codes.MISSING_METHOD,
            source.span(at, at + len(method.name)),
            f"`{name}` has no method for {method.what}; this stub was added",
            label=f"is `{guess}` meant for it?"
            if (guess := similar_method(user, method, methods))
            else "",
            notes=[method.origin],
            help="put your code into it"
            + ("; until then callers receive an error" if method.code.call else ""),
        )


def _places(source: Source) -> dict[str, int]:
    """Positions of the methods' names in the class; a stub is the last definition of its name."""
    module = parsed(source)
    worker = module.worker
    functions = [s for s in worker.body if isinstance(s, Function)] if worker else []
    return {function.name: module.span_of(function).start for function in functions}


def _class(user: UserModule) -> _Class:
    import libcst as cst  # noqa: PLC0415 - heavy, and needed only where a method is missing
    from libcst.metadata import MetadataWrapper, PositionProvider  # noqa: PLC0415

    wrapper = MetadataWrapper(cst.parse_module(user.source.text), unsafe_skip_copy=True)
    module = wrapper.module
    places = wrapper.resolve(PositionProvider)
    name = user.worker.name if user.worker else CLASS
    worker = [n for n in module.body if isinstance(n, cst.ClassDef) and n.name.value == name][-1]
    last = worker.body.body[-1]
    end = places[last].end
    offset = user.starts[end.line - 1] + end.column
    step = module.default_indent
    opened = None
    indent = step
    if isinstance(worker.body, cst.IndentedBlock):
        indent = worker.body.indent or step
    else:
        start = places[worker.body.body[0]].start
        opened = user.starts[start.line - 1] + start.column
    return _Class(offset, opened, indent, step, module.default_newline)


def _after_line(text: str, at: int, more: str, newline: str) -> str:
    """Insert `more` after the line of offset `at`."""
    end = re.compile(r"\r\n?|\n").search(text, at)
    if end is None:
        return f"{text}{newline}{more}"
    return text[: end.end()] + more + text[end.end() :]


def _stub(method: Method, local: dict[str, str], found: _Class) -> str:
    """A blank line and the method, with the file's indentation."""
    body = [method.code.doc]
    if method.code.call:
        body += ["# Put your code here. Until then callers receive an error."]
        body += [method.code.call]
    rows = [f"{STEP}{_renamed(method.code.definition, local)}", *(STEP * 2 + row for row in body)]
    lines = "\n".join(rows).split("\n")
    return found.newline + "".join(_indented(row, found) + found.newline for row in lines)


def _indented(row: str, found: _Class) -> str:
    bare = row.lstrip(" ")
    depth, rest = divmod(len(row) - len(bare), len(STEP))
    if not bare or not depth:
        return bare
    return found.indent + found.step * (depth - 1) + " " * rest + bare


def _renamed(definition: str, local: dict[str, str]) -> str:
    """The `def` with the types' names in the user's module."""
    changed = {name: new for name, new in local.items() if name != new}
    if not changed:
        return definition
    names = "|".join(map(re.escape, changed))
    annotation = re.compile(rf"(?<=[\[ ])(?:{names})\b(?!: )")
    return annotation.sub(lambda m: changed[m.group()], definition)


def _imports(
    user: UserModule, missing: Iterable[Method], package: str
) -> tuple[dict[str, str], list[str]]:
    """The names of the types in the user's module, and the missing import lines."""
    module = f"{package}.interfaces"
    needed = dict.fromkeys(name for method in missing for name in method.types)
    runtime, runtime_line = RUNTIME_TYPES
    needs_runtime = runtime in needed
    needed.pop(runtime, None)
    local: dict[str, str] = {}
    star = False
    for node in user.tree.body:
        if isinstance(node, ast.ImportFrom) and node.module == module and not node.level:
            star = star or any(a.name == "*" for a in node.names)
            local |= {a.name: a.asname or a.name for a in node.names}
    taken = bound_names(user.tree)
    fresh = [n for n in needed if n not in local and n not in taken and not star]
    clashing = [n for n in needed if n not in local and n in taken]
    local |= {name: f"{QUALIFIER}.{name}" for name in clashing}
    lines = [f"from {module} import {', '.join(sorted(fresh))}"] if fresh else []
    if needs_runtime and runtime not in taken:
        lines.insert(0, runtime_line)
    if clashing and QUALIFIER not in taken:
        lines.append(f"from {package} import interfaces as {QUALIFIER}")
    return local, lines


def _import_place(user: UserModule, module: str) -> int | None:
    """Offset after the import that new ones follow: the import of the types, or the last one.

    Without imports they follow the last statement above the class; None if there is none.
    """
    line = user.worker.lineno if user.worker else 0
    above = [n for n in user.tree.body if n.lineno < line]
    imports = [n for n in above if isinstance(n, ast.Import | ast.ImportFrom)]
    types = [n for n in imports if isinstance(n, ast.ImportFrom) and n.module == module]
    if not above:
        return None
    last = (types or imports or above)[-1]
    return user.offset(last.end_lineno or last.lineno, last.end_col_offset or 0)

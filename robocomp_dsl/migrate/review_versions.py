"""Review names that old code uses, and that today's Python and numpy do not have.

In: the modules that the worker imports, in Python 3. Out: findings about names of Python 2, about
names that the standard library or numpy has removed, and about pickles in text files.
"""

from __future__ import annotations

import ast
import importlib.util
import sys
import warnings
from collections.abc import Iterable, Iterator, Sequence

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.regeneration.user_module import UserModule
from robocomp_dsl.migrate import standard_library
from robocomp_dsl.migrate.import_nodes import optional_nodes
from robocomp_dsl.migrate.imports import span_of
from robocomp_dsl.migrate.worker_codes import DIFFERENT_PROCESS

_PYTHON_2 = {
    "basestring": "str",
    "execfile": "exec(open(…).read())",
    "long": "int",
    "raw_input": "input",
    "reduce": "functools.reduce",
    "unichr": "chr",
    "unicode": "str",
    "xrange": "range",
}
"""Functions of Python 2, and what replaces them."""
_METHODS = {"has_key": "in", "iteritems": "items", "iterkeys": "keys", "itervalues": "values"}
"""Methods of dictionaries in Python 2, and what replaces them."""
_NUMPY = dict.fromkeys(
    ("bool8", "complex_", "float_", "int0", "object0", "str0", "unicode_"),
    "numpy has removed this type",
) | {
    "fromstring": "numpy has removed `fromstring` for bytes: write `frombuffer`",
    "float": "numpy has removed `float`: write Python's `float`",
    "int": "numpy has removed `int`: write Python's `int`",
    "object": "numpy has removed `object`: write Python's `object`",
    "str": "numpy has removed `str`: write Python's `str`",
    "asscalar": "numpy has removed `asscalar`: write `a.item()`",
    "product": "numpy has removed `product`: write `prod`",
    "cumproduct": "numpy has removed `cumproduct`: write `cumprod`",
    "NaN": "numpy has removed `NaN`: write `nan`",
    "Inf": "numpy has removed `Inf`: write `inf`",
}
"""Names that numpy has removed."""

_Finding = tuple[ast.expr | ast.stmt, str]


def review_versions(modules: Sequence[UserModule], report: Report) -> None:
    """Report what newer versions of Python and numpy do not have, or do otherwise."""
    for module in modules:
        found = [*_old_names(module.tree), *_removed_names(module.tree), *_pickles(module.tree)]
        for place, message in found:
            report.add(DIFFERENT_PROCESS, span_of(module, place), message)


def _old_names(tree: ast.Module) -> Iterator[_Finding]:
    """The names of Python 2 that a module does not define itself."""
    own = _bound_names(tree)
    for node in ast.walk(tree):
        match node:
            case ast.Name(id=name, ctx=ast.Load()) if name in _PYTHON_2 and name not in own:
                yield node, f"`{name}` is Python 2; in Python 3 it is `{_PYTHON_2[name]}`"
            case ast.Call(func=ast.Attribute(attr=name) as function) if name in _METHODS:
                yield function, f"`{name}` is Python 2; in Python 3 it is `{_METHODS[name]}`"


def _removed_names(tree: ast.Module) -> Iterator[_Finding]:
    """The names that modules of Python and numpy do not have any more."""
    aliases = _imported_modules(tree)
    skipped = {*_import_nodes(optional_nodes(tree)), *_text_readers(tree)}
    for node in ast.walk(tree):
        match node:
            case _ if node in skipped:
                continue
            case ast.Attribute(value=ast.Name(id=owner), attr=name) if owner in aliases:
                if (problem := _lacking(aliases[owner], name)) is not None:
                    yield node, problem
            case ast.ImportFrom(module=str(module), level=0):
                problems = (_lacking(module, alias.name) for alias in node.names)
                yield from ((node, problem) for problem in problems if problem is not None)


def _import_nodes(nodes: Iterable[ast.AST]) -> Iterator[ast.AST]:
    return (node for node in nodes if isinstance(node, ast.Import | ast.ImportFrom))


def _text_readers(tree: ast.Module) -> Iterator[ast.expr]:
    """The functions of calls with `sep`: numpy still reads numbers from texts."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and any(k.arg == "sep" for k in node.keywords):
            yield node.func


def _pickles(tree: ast.Module) -> Iterator[_Finding]:
    """The pickles in files that are opened as text; Python 2 made no difference."""
    for node in ast.walk(tree):
        match node:
            case ast.Call(
                func=ast.Attribute(value=ast.Name(id="pickle"), attr="load" | "dump" as name)
            ) if any(_is_text_file(argument) for argument in node.args[:2]):
                yield node, f"`pickle.{name}` needs a file in binary mode: `rb` or `wb`"
            case ast.Call(func=ast.Attribute(value=ast.Name(id="pickle"), attr="loads")) if any(
                _reads_text(argument) for argument in node.args[:1]
            ):
                yield node, "`pickle.loads` needs bytes: open the file in mode `rb`"


def _lacking(module: str, name: str) -> str | None:
    """Why a module does not have a name; None if it has it, or is not known here."""
    if name == "*" or name.startswith("__"):
        return None
    if module == "numpy":
        return _NUMPY.get(name)
    if not standard_library.is_known(module) or _has(module, name):
        return None
    version = f"{sys.version_info.major}.{sys.version_info.minor}"
    return f"the module `{module}` of Python {version} has no `{name}`"


def _has(module: str, name: str) -> bool:
    """Whether a module of the standard library has a name; also if it is for another system."""
    loaded = standard_library.load(module)
    if loaded is None:
        return True
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return hasattr(loaded, name) or _is_module(f"{module}.{name}")


def _is_module(name: str) -> bool:
    try:
        return importlib.util.find_spec(name) is not None
    except (ImportError, ValueError):
        return False


def _imported_modules(tree: ast.Module) -> dict[str, str]:
    """The modules that `import a as b` binds, by the bound name; not those that are rebound."""
    bound: dict[str, str] = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                if alias.asname or "." not in alias.name:
                    bound[alias.asname or alias.name] = alias.name
    stored = {
        n.id for n in ast.walk(tree) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)
    }
    stored |= {n.arg for n in ast.walk(tree) if isinstance(n, ast.arg)}
    return {name: module for name, module in bound.items() if name not in stored}


def _bound_names(tree: ast.Module) -> set[str]:
    """All names that a module binds somewhere."""
    names: set[str] = set()
    for node in ast.walk(tree):
        match node:
            case ast.Name(id=name, ctx=ast.Store()) | ast.arg(arg=name):
                names.add(name)
            case ast.FunctionDef(name=name) | ast.ClassDef(name=name):
                names.add(name)
            case ast.Import(names=aliases) | ast.ImportFrom(names=aliases):
                names |= {a.asname or a.name for a in aliases}
    return names


def _is_text_file(node: ast.expr) -> bool:
    """Whether an expression is `open(…)` in text mode."""
    match node:
        case ast.Call(func=ast.Name(id="open"), args=arguments, keywords=keywords):
            modes = [*arguments[1:2], *(k.value for k in keywords if k.arg == "mode")]
            texts = [m.value for m in modes if isinstance(m, ast.Constant)]
            return len(texts) == len(modes) and not any("b" in str(text) for text in texts)
    return False


def _reads_text(node: ast.expr) -> bool:
    match node:
        case ast.Call(func=ast.Attribute(value=value, attr="read")):
            return _is_text_file(value)
    return False

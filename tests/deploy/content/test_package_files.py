"""The files of the package that hosts get for components."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from robocomp_dsl.deploy.content.package_files import PackageFile, is_runtime, package_files


def imports_of_start(file: PackageFile) -> Iterator[str]:
    """The modules of this project that a module imports when it is loaded."""
    pending: list[ast.AST] = [ast.parse(file.source.read_text("utf-8"))]
    while pending:
        for node in ast.iter_child_nodes(pending.pop()):
            if isinstance(node, ast.ImportFrom):
                yield node.module or ""
            elif isinstance(node, ast.Import):
                yield from (alias.name for alias in node.names)
            elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef) or is_type_check(node):
                continue
            else:
                pending.append(node)


def is_type_check(node: ast.AST) -> bool:
    test = node.test if isinstance(node, ast.If) else None
    return isinstance(test, ast.Name) and test.id == "TYPE_CHECKING"


def test_package_files_of_components_import_no_file_that_hosts_lack() -> None:
    files = [f for f in package_files(complete=False) if f.name.endswith(".py")]
    missing = {
        f"{file.name} imports {module}"
        for file in files
        for module in imports_of_start(file)
        if module.startswith("robocomp_dsl.") and not is_runtime(module)
    }
    assert len(files) > 100
    assert not missing

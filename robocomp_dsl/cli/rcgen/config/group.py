"""`rcgen config`: configuration contexts of the user and of installed packages.

In: a sub-command. Out: its output; exit code 1 if the requested context or file does not exist.
"""

from __future__ import annotations

from robocomp_dsl.cli.program import LazyGroup

TABLE = {
    "list": (
        "rcgen.config.list_contexts",
        "List contexts and their files, and which file of a name wins.",
    ),
    "where": (
        "rcgen.config.where",
        "List the folders in which a file is searched, and the match.",
    ),
    "import": (
        "rcgen.config.import_copies",
        "Copy an installed context, or one file of it, into your own folder.",
    ),
    "diff": ("rcgen.config.diff", "Compare your files of a context with the installed ones."),
}

command = LazyGroup(
    "config",
    table=TABLE,
    help="List, import and compare the configurations of contexts: those that components find "
    "with `--context` and `--from`.",
)

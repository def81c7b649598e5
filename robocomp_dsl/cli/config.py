"""`rcgen config`: the configurations of contexts, those of the user and those installed.

In: a sub-command. Out: what it says; exit code 1 where there is nothing of what was asked for.
"""

from __future__ import annotations

from robocomp_dsl.cli.program import LazyGroup

TABLE = {
    "list": ("config_list", "Contexts, their files, and which of several of a name wins."),
    "where": ("config_where", "Each place in which a file is searched, and the one that wins."),
    "import": ("config_import", "Copy an installed context, or one file of it, to change it."),
    "diff": ("config_diff", "What your files of a context change of the installed ones."),
}

command = LazyGroup(
    "config",
    table=TABLE,
    help="List, import and compare the configurations of contexts: those that components find "
    "with `--context` and `--from`.",
)

"""Finds the configuration of a component in folders of the user and of installed packages.

In: a file name or a context, the environment. Out: the file that wins, and every candidate. The
search is that of YARP's ResourceFinder, in the folders of the XDG base directory specification.
"""

from robocomp_dsl.runtime.config.candidates import (
    Candidate,
    InvalidName,
    search,
    validate_context,
    validate_file,
)
from robocomp_dsl.runtime.config.contexts import context_names, files_of
from robocomp_dsl.runtime.config.drop_ins import drop_in_roots
from robocomp_dsl.runtime.config.resolve import (
    ConfigRequest,
    ConfigResult,
    existing_configs,
    resolve_config,
)
from robocomp_dsl.runtime.config.search_environment import (
    Origin,
    Root,
    SearchEnvironment,
)
from robocomp_dsl.runtime.config.search_paths import CONTEXTS, SearchPath, search_paths

__all__ = [
    "CONTEXTS",
    "Candidate",
    "ConfigRequest",
    "ConfigResult",
    "InvalidName",
    "Origin",
    "Root",
    "SearchEnvironment",
    "SearchPath",
    "context_names",
    "drop_in_roots",
    "existing_configs",
    "files_of",
    "resolve_config",
    "search",
    "search_paths",
    "validate_context",
    "validate_file",
]

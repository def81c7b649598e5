"""Finds the configuration of a component among folders of the user and installed ones.

In: a file name or a context, the environment. Out: the file that wins, and every place tried. The
search is that of YARP's ResourceFinder, in the folders of the XDG base directory specification.
"""

from robocomp_dsl.runtime.config.choose import Asked, Chosen, choose, files_beside
from robocomp_dsl.runtime.config.contexts import context_names, files_of
from robocomp_dsl.runtime.config.drop_ins import dropped
from robocomp_dsl.runtime.config.find import (
    Tried,
    WrongName,
    checked_context,
    checked_file,
    search,
)
from robocomp_dsl.runtime.config.places import CONTEXTS, Place, places
from robocomp_dsl.runtime.config.surroundings import Origin, Root, Surroundings, surroundings

__all__ = [
    "CONTEXTS",
    "Asked",
    "Chosen",
    "Origin",
    "Place",
    "Root",
    "Surroundings",
    "Tried",
    "WrongName",
    "checked_context",
    "checked_file",
    "choose",
    "context_names",
    "dropped",
    "files_beside",
    "files_of",
    "places",
    "search",
    "surroundings",
]

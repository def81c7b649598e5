"""The findings about old components and deployments that do not run as they did.

An error is what the new component cannot do as before; it is reported with its line.
"""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

ONLY_STAND_INS = Code(
    "RC945",
    Severity.ERROR,
    "a deployment consists of stand-ins only",
    """None of the processes of the manager's file was matched with the folder of a component, so
the deployment can be checked, but does nothing. Name the folders, too; a process is matched by its
folder, its program or its alias:

    rcgen migrate manager.xml laser/ base/ follow/ -o robot""",
)

MISSING_MODULE = Code(
    "RC895",
    Severity.ERROR,
    "an imported module is not installed",
    """The worker, or a module that it imports, imports a module that Python does not find here:
it is neither in the old folder nor installed. The component does not start without it. Install it
in the environment of the component, or remove the import:

    pip install opencv-python            # import cv2""",
)

MISSING_NAME = Code(
    "RC896",
    Severity.ERROR,
    "the interface file lacks a name that the code uses",
    """The code uses a type or a module of an interface that the IDSL file, as it was found, does
not have. Old components often need an older version of the file. Name its folder, remove the new
folder and run `rcgen migrate` again:

    rcgen migrate robot/ -I ~/robocomp/interfaces/IDSLs""",
)

HOOK_NAME = Code(
    "RC897",
    Severity.ERROR,
    "a method has the name of a hook",
    """RoboComp never called `emergency`, `restore`, `finalize` and the other hooks of the new
component by itself; now they are called at these moments. Rename the method, and its
calls, in the new `specificworker.py`.""",
)

PYTHON_2 = Code(
    "RC898",
    Severity.WARNING,
    "Python 2 was converted to Python 3",
    """The module is Python 2. `fissix`, the successor of `2to3`, converted its syntax; quotients
of whole numbers and `round` have the results of Python 2. The old file is unchanged. Read the
converted file once: Python 3 separates texts and bytes, which no tool converts.""",
)

DIFFERENT_PROCESS = Code(
    "RC899",
    Severity.ERROR,
    "the code behaves differently in the new component",
    """The line depends on how RoboComp started the process (its arguments, its main thread), or
on Python 2 (texts and bytes). No automatic replacement is possible. The finding says what
differs; change the line in the new folder.""",
)

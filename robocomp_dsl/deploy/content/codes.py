"""Finding codes of what is copied to hosts."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

FILE = Code(
    "RC845",
    Severity.ERROR,
    "file cannot be copied to a host",
    """\
`rcdeploy up` copies the folder of a component, its configuration and the files that `set`, `files`
and monitors name. Each must be readable, no larger than 1 GiB, and a symbolic link must lead to a
file or folder that exists. A component may have 20 000 files of 4 GiB together.

Wrong:

    component eye on robot { files "../recordings"; };     // 30 GB

Right:

    component eye on robot { files "../recordings/calibration.yaml"; };
""",
)

DISTRIBUTION = Code(
    "RC846",
    Severity.ERROR,
    "Python package not available for a host",
    """\
A host gets the Python packages that its components import, in the versions that are installed on
this machine. A wheel of each must exist for the processor, the C library and the Python of the
host. It is taken from the cache, from the package index, or from this machine's installation if
that fits the host. A component names further packages in `requirements.txt` beside its CDSL file:

    scipy>=1.11
    pyserial

Install them here first; the versions found here are the versions on the host:

    python3 -m pip install -r components/arm/requirements.txt
""",
)

SPACE = Code(
    "RC848",
    Severity.ERROR,
    "not enough space on a host",
    """\
Before it copies anything, rcdeploy compares the free space of the host's file system with the size
of the files and Python environments that the host lacks. Delete files there, or copy less: `files`
and the component's folder are copied with all they contain.
""",
)

LARGE = Code(
    "RC849",
    Severity.WARNING,
    "large component folder",
    """\
The folder of a component is copied to its host with all files in it. Recordings, models and build
results make that slow. Move what the component does not need out of its folder. Not copied are
`.git`, `.rcgen`, `.venv`, `__pycache__`, `node_modules`, and caches of tools.
""",
)

"""Finding codes of `rcdeploy export`: what another system cannot hold or do."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

FOLDER = Code(
    "RC860",
    Severity.ERROR,
    "the folder has files of others",
    """\
`rcdeploy export` writes into a folder of its own, and later replaces only what it has written: the
file `.rcdeploy-export.json` lists the files with their checksums. A file that is not in this list,
or that was changed since, is not overwritten.

    rcdeploy export app.ddsl --to compose build/compose      // a new folder

Keep your own changes outside: an override file of compose, an overlay of Kustomize, a drop-in of
systemd.
""",
)

INEXPRESSIBLE = Code(
    "RC861",
    Severity.WARNING,
    "a setting is not exported",
    """\
The other system has nothing that does the same. The exported deployment runs without it; the help
of the finding says what happens instead.

    component arm { restart never; };      // Kubernetes restarts every container that ends
""",
)

VALUE = Code(
    "RC862",
    Severity.ERROR,
    "a value cannot be exported",
    """\
A value contains what the file format of the other system cannot hold, such as a control character
in a unit of systemd. Write it into a configuration file of the component, which is copied as it is.
""",
)

UNREACHABLE = Code(
    "RC863",
    Severity.ERROR,
    "a middleware does not leave a container",
    """\
Each component runs in a container of its own. `local` uses shared memory and sockets of one
machine, which do not connect containers. zenoh does.

    Deployment robot { middleware local; component arm; };        // on one machine, or with systemd
    Deployment robot { component arm; };                          // zenoh
""",
)

MAYBE_UNREACHABLE = Code(
    "RC864",
    Severity.WARNING,
    "a program may be out of reach",
    """\
In containers `localhost` is not the machine. Programs outside of the deployment, and ports of other
middlewares than zenoh, are reached through the network of the containers: give their addresses, and
publish the ports that others connect to.
""",
)

SECRET = Code(
    "RC865",
    Severity.WARNING,
    "a variable that looks like a secret is not exported",
    """\
The value of a variable whose name ends in PASSWORD, PASSPHRASE, SECRET, TOKEN or API_KEY is not
written into exported files, which are made to be shared. Give it where the deployment runs, in a
file that the component reads:

    component arm { set password_file = "/run/secrets/arm"; };
""",
)

DEVICE = Code(
    "RC866",
    Severity.WARNING,
    "a device needs permission in the cluster",
    """\
A container of Kubernetes gets a device file of its node only if it is privileged, or from a device
plugin. The exported deployment mounts the file and asks for a privileged container; an
administrator has to allow that in the namespace.
""",
)

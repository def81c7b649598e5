"""Finding codes of deployments over several hosts."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNIT_VALUE = Code(
    "RC840",
    Severity.ERROR,
    "value that a systemd unit cannot hold",
    """\
On several hosts each component is a systemd service. Its command line and environment must be valid
UTF-8 without a zero byte, and an environment variable has no control characters but tab and line
end.

Wrong:

    component arm on robot { env BELL = "\\x07"; };

Right:

    component arm on robot { config "arm.yaml"; };         // with the value in that file
""",
)

RUNS_HERE = Code(
    "RC841",
    Severity.ERROR,
    "deployment runs with a supervisor",
    """\
A deployment with components on other hosts is run by systemd on each host. A deployment of the same
name already runs on this machine with rcdeploy as its supervisor. Stop that one, or use another
name:

    rcdeploy stop app
    rcdeploy up app.ddsl --name other
""",
)

MIDDLEWARE = Code(
    "RC842",
    Severity.ERROR,
    "connection between hosts needs another middleware",
    """\
`local` and `inproc` connect components of one machine. Between hosts zenoh carries the messages;
`ice`, `ros1`, `ros2`, `yarp` and `dds` do so with their own settings.

Wrong:

    component eye on robot;
    component view on desk;
    connect view.Camera -> eye.Camera over local;

Right:

    connect view.Camera -> eye.Camera;
""",
)

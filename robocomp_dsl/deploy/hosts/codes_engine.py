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

"""Finding codes of the routers between hosts."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

ADDRESS_IN_USE = Code(
    "RC870",
    Severity.ERROR,
    "router cannot listen on a host",
    """\
The router of a host listens at the address and port of the host, and on loopback. rcdeploy tries
this before it changes anything, unless the router already runs. Here another program uses the port,
or the host has no such address, for instance because it is behind a NAT.

Wrong, if another program on 10.0.0.2 uses the port 7450:

    host robot { address "10.0.0.2"; port 7450; };

Right:

    host robot { address "10.0.0.2"; port 7451; };

`ss -ltnp` on the host shows which program uses a port. Without `port` the number follows from the
name of the deployment.
""",
)

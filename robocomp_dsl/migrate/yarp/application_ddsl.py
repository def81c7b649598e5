"""Writes the deployment of an application of yarpmanager.

In: an `ApplicationDraft`. Out: the text of a DDSL file.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from robocomp_dsl.generate.literals import printable, quoted
from robocomp_dsl.migrate.yarp.application import Application
from robocomp_dsl.migrate.yarp.programs import (
    ApplicationDraft,
    ConnectionDraft,
    HostDraft,
    ProgramDraft,
)

STEP = "    "


def application_text(name: str, draft: ApplicationDraft) -> str:
    """The DDSL file of an application."""
    rows = ["/**", *(f" * {row}" for row in _description(draft.application)), " */"]
    rows += [f"Deployment {name}", "{"]
    rows += [_host(host) for host in draft.hosts.values()]
    rows += [""] if draft.hosts else []
    for program in draft.programs:
        rows += _program(program)
    rows += [""] if draft.programs and draft.connections else []
    rows += [_connection(connection) for connection in draft.connections]
    return "\n".join([*rows, "};", ""])


def _description(application: Application) -> Iterator[str]:
    """The lines of the doc comment."""
    about = application.description or f"The application {application.name} of yarpmanager."
    for text in (about, *application.authors):
        yield printable(text).replace("*/", "* /")
    if application.version:
        yield f"Version {printable(application.version).replace('*/', '* /')}"


def _host(host: HostDraft) -> str:
    if not host.address:
        return f"{STEP}host {host.name};"
    user = f" user {quoted(host.user)};" if host.user else ""
    return f"{STEP}host {host.name} {{ address {quoted(host.address)};{user} }};"


def _program(program: ProgramDraft) -> Iterator[str]:
    place = f" on {program.node}" if program.node else ""
    yield f"{STEP}program {program.name}{place}"
    yield f"{STEP}{{"
    yield f"{STEP * 2}executable {quoted(program.command)};"
    for key, value in program.environment:
        yield f"{STEP * 2}env {key} = {quoted(value)};"
    if program.by_load:
        yield f"{STEP * 2}place by load;"
    yield f"{STEP * 2}ready after {program.ready_s:g} s;"
    yield f"{STEP}}};"


def _connection(connection: ConnectionDraft) -> str:
    carrier = connection.carrier
    plain = re.fullmatch(r"[A-Za-z_]\w*", carrier, re.ASCII)
    how = f" carrier {carrier if plain else quoted(carrier)}" if carrier else ""
    return f"{STEP}connect yarp {quoted(connection.source)} -> {quoted(connection.target)}{how};"

"""Formats parts of a plan as text. Pure."""

from __future__ import annotations

from robocomp_dsl.model.deployment import UNPLACED, Clock, Host, Instance, Readiness


def describe_host(host: Host) -> str:
    """The name and address of a host; empty for this machine without a name."""
    if host is UNPLACED:
        return ""
    same = host.address in ("", host.name) or not host.name
    return host.name if same else f"{host.name} ({host.address})"


def describe_placement(instance: Instance) -> str:
    """How a host will be chosen: `on label gpu (robot, desk)`; empty if it has one."""
    if instance.host is not UNPLACED:
        return ""
    placement = instance.placement
    candidates = f" ({', '.join(placement.candidates)})" if placement.label else ""
    return f"{placement}{candidates}"


def describe_clock(clock: Clock) -> str:
    """A clock as text: `simulated, from body`."""
    if clock.source is None:
        return "wall"
    text = f"simulated, from {clock.source.full_name}"
    if not clock.lockstep:
        return text
    on_timeout = "stops" if clock.stop_on_timeout else "continues without the component"
    return f"{text}, lock-step: at most {clock.limit_s:g} s per step, {on_timeout} on a time-out"


def format_readiness(readiness: Readiness) -> str:
    """When a program is ready: `when port 8080 answers`; empty if its lifecycle tells."""
    if readiness.pattern:
        return f'when log matches "{readiness.pattern}"'
    if readiness.port:
        return f"when port {readiness.port} answers"
    return f"after {readiness.delay_s:g} s" if readiness.delay_s else ""

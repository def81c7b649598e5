"""`rcdeploy param`: reads and changes parameters of running components.

In: a running deployment, a component of it, parameters. Out: a table or values; exit code 1 if a
component rejects a change; then nothing has changed.
"""

from __future__ import annotations

import json
import shlex
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

import click

from robocomp_dsl.cli.program import EXIT_FINDINGS, CliError
from robocomp_dsl.cli.rcdeploy import running
from robocomp_dsl.deploy.engine import Engine
from robocomp_dsl.diagnostics import did_you_mean

if TYPE_CHECKING:
    from robocomp_dsl.deploy.component_queries import ProxyFactory
    from robocomp_dsl.runtime.component.component_interface import ComponentProxy, ParameterInfo

CALL_TIMEOUT_S = 5.0
CONNECT_TIMEOUT_S = 2.0
"""For all components of a command together; over hosts, routers are connected first."""

which = click.argument("which", metavar="APP.ddsl|NAME")
output_format = click.option(
    "--format", "output_format", type=click.Choice(["text", "json"]), default="text"
)


@click.group()
def command() -> None:
    """Read and change the parameters of running components."""


@command.command("list")
@which
@click.argument("components", nargs=-1, metavar="[COMPONENT]...")
@output_format
def list_(which: str, components: tuple[str, ...], output_format: str) -> None:
    """List the parameters of all components, or of some."""
    deployment = running.resolve_deployment(which)
    known = running.answering_components(deployment)
    selected = [running.resolve_component(name, known) for name in components] or known
    found = {}
    deadline = time.monotonic() + CONNECT_TIMEOUT_S
    with _proxies(deployment) as proxy_of:
        for name in selected:
            proxy = proxy_of(name)
            if proxy.wait_for_server(max(deadline - time.monotonic(), 0.0)):
                found[name] = list(proxy.getParameters())
    if output_format == "json":
        data = {name: [_data(p) for p in parameters] for name, parameters in found.items()}
        print(json.dumps(data, indent=1))
    else:
        print("\n".join(_table(found)))
    if silent := [name for name in selected if name not in found]:
        raise CliError(EXIT_FINDINGS, _no_answer(silent))


@command.command()
@which
@click.argument("component")
@click.argument("names", nargs=-1, required=True, metavar="PARAMETER...")
def get(which: str, component: str, names: tuple[str, ...]) -> None:
    """Print the values of parameters, one per line."""
    deployment = running.resolve_deployment(which)
    full_name = running.resolve_component(component, running.answering_components(deployment))
    with _proxies(deployment) as proxy_of:
        parameters = {p.name: p for p in _parameters(proxy_of, full_name)}
    for name in names:
        if name not in parameters:
            hint = did_you_mean(name, parameters)
            raise CliError(
                EXIT_FINDINGS,
                f"`{component}` has no parameter `{name}`" + (f"; {hint}" if hint else ""),
            )
        print(parameters[name].value)


@command.command("set")
@which
@click.argument("component")
@click.argument("changes", nargs=-1, required=True, metavar="PARAMETER=VALUE...")
@click.option("--save", is_flag=True, help="Save the live values for the next start.")
@click.option("--ddsl", is_flag=True, help="Write the values into the deployment's file.")
def set_(which: str, component: str, changes: tuple[str, ...], *, save: bool, ddsl: bool) -> None:
    """Change live parameters; either all changes are accepted or none."""
    from robocomp_dsl.runtime.component.component_interface import Refusal  # noqa: PLC0415 - loads numpy

    values = dict(map(_change, changes))
    deployment = running.resolve_deployment(which)
    name = running.resolve_component(component, running.answering_components(deployment))
    with _proxies(deployment) as proxy_of:
        proxy = _connect(proxy_of, name)
        try:
            proxy.setParameters(values)
            where = proxy.saveParameters() if save else ""
            types = {p.name: p.type for p in proxy.getParameters()} if ddsl else {}
        except Refusal as refusal:
            raise CliError(
                EXIT_FINDINGS, f"`{name}` rejects the change: {refusal.reason}"
            ) from None
    print(f"{name}: {', '.join(f'{k} = {v}' for k, v in values.items())}")
    if where:
        print(f"kept in {where}")
    if ddsl:
        _write_to_ddsl(deployment, name, values, types)
    elif save:
        _report_overriding(deployment, name, component, values)


def _write_to_ddsl(
    deployment: Engine,
    name: str,
    values: dict[str, str],
    types: dict[str, str],
) -> None:
    """Write `set` statements into the file of the deployment."""
    from robocomp_dsl.deploy import ddsl_settings  # noqa: PLC0415 - loads the parser

    literals = {
        parameter: ddsl_settings.format_ddsl_value(parameter, value, types)
        for parameter, value in values.items()
    }
    try:
        ddsl_settings.write_settings(Path(deployment.path), name, literals)
    except ddsl_settings.CannotEdit as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None
    print(f"written to {deployment.path}")


def _report_overriding(
    deployment: Engine, name: str, component: str, values: dict[str, str]
) -> None:
    """Say which saved values the deployment overrides at the next start."""
    from robocomp_dsl.deploy import ddsl_settings  # noqa: PLC0415 - loads the parser

    path = Path(deployment.path)
    overriding = {p: ddsl_settings.find_setting(path, name, p) for p in values}
    for parameter, setting in overriding.items():
        if setting:
            print(
                f"{setting.place} has `set {parameter} = {setting.value};`, which overrides the "
                "saved value at the next start"
            )
    if any(overriding.values()):
        changes = " ".join(shlex.quote(f"{p}={values[p]}") for p, s in overriding.items() if s)
        print(
            f"to write it there: rcdeploy param set {deployment.name} {component} {changes} --ddsl"
        )


def _change(text: str) -> tuple[str, str]:
    name, sign, value = text.partition("=")
    if not sign or not name:
        raise click.UsageError(f"`{text}` is no change; write PARAMETER=VALUE, as in rate=20")
    return name.strip(), value


@contextmanager
def _proxies(deployment: Engine) -> Iterator[ProxyFactory]:
    """Proxies of the `Component` interface of a deployment's components."""
    from robocomp_dsl.deploy import component_queries  # noqa: PLC0415 - loads a middleware
    from robocomp_dsl.runtime.errors import MiddlewareError, Timeout  # noqa: PLC0415

    try:
        with component_queries.component_proxies(deployment.domain, CALL_TIMEOUT_S) as proxy_of:
            yield proxy_of
    except Timeout as error:
        raise CliError(
            EXIT_FINDINGS,
            f"a component does not answer within {CALL_TIMEOUT_S:g} s; is it stuck? ({error})",
        ) from None
    except MiddlewareError as error:
        raise CliError(EXIT_FINDINGS, str(error)) from None


def _connect(proxy_of: ProxyFactory, name: str) -> ComponentProxy:
    proxy = proxy_of(name)
    if not proxy.wait_for_server(CONNECT_TIMEOUT_S):
        raise CliError(EXIT_FINDINGS, _no_answer([name]))
    return proxy


def _no_answer(names: Sequence[str]) -> str:
    listed = " and ".join(f"`{name}`" for name in names)
    verb = "does" if len(names) == 1 else "do"
    hint = "see `rcdeploy status`; components of other middlewares than zenoh are not reached"
    return f"{listed} {verb} not answer within {CONNECT_TIMEOUT_S:g} s; {hint}"


def _parameters(proxy_of: ProxyFactory, name: str) -> list[ParameterInfo]:
    return list(_connect(proxy_of, name).getParameters())


def _table(found: dict[str, list[ParameterInfo]]) -> Iterator[str]:
    """A line for each parameter: component, name, value, accepted values, doc comment."""
    rows = [
        (
            name,
            parameter.name,
            parameter.value,
            _accepted_values(parameter),
            "live" if parameter.live else "",
            parameter.doc,
        )
        for name, parameters in found.items()
        for parameter in parameters
    ]
    heads = ("COMPONENT", "PARAMETER", "VALUE", "TAKES", "", "")
    lines = [heads, *rows]
    widths = [max(len(line[i]) for line in lines) for i in range(len(heads))]
    for line in lines:
        cells = (text.ljust(width) for text, width in zip(line, widths, strict=True))
        yield "  ".join(cells).rstrip()
    yield from (f"{name} has no parameters" for name, parameters in found.items() if not parameters)


def _accepted_values(deployment: ParameterInfo) -> str:
    unit = f" [{deployment.unit}]" if deployment.unit else ""
    if deployment.choices:
        length = deployment.type.removeprefix("choice")
        return f"{' | '.join(deployment.choices)}{f' {length}' if length else ''}"
    bounds = f" {deployment.low}:{deployment.high}" if deployment.low or deployment.high else ""
    return f"{deployment.type}{bounds}{unit}"


def _data(deployment: ParameterInfo) -> dict[str, object]:
    return {
        key: getattr(deployment, key)
        for key in ("name", "value", "type", "unit", "live", "low", "high", "choices", "doc")
    }

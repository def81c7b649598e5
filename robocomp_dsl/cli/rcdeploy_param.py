"""`rcdeploy param`: parameters of running components, read and changed while they run.

In: a running deployment, a component of it, parameters. Out: a table or values; exit code 1 where
a component refuses, and then nothing has changed.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Never

import click

from robocomp_dsl.cli import rcdeploy_running
from robocomp_dsl.deploy import folder
from robocomp_dsl.diagnostics import did_you_mean

if TYPE_CHECKING:
    from robocomp_dsl.deploy.reach import ProxyOf
    from robocomp_dsl.runtime.component_interface import ComponentProxy, ParameterInfo

PATIENCE_S = 5.0

which = click.argument("which", metavar="APP.ddsl|NAME")
form = click.option("--format", "form", type=click.Choice(["text", "json"]), default="text")


@click.group()
def command() -> None:
    """Read and change the parameters of running components."""


@command.command("list")
@which
@click.argument("components", nargs=-1, metavar="[COMPONENT]...")
@form
def list_(which: str, components: tuple[str, ...], form: str) -> None:
    """All parameters, of all components or of those named."""
    one = rcdeploy_running.find(which)
    known = rcdeploy_running.components(one)
    wanted = [rcdeploy_running.meant(name, known) for name in components] or known
    found = {}
    with _proxies(one) as proxy_of:
        for name in wanted:
            found[name] = _parameters(proxy_of, name)
    if form == "json":
        data = {name: [_data(p) for p in parameters] for name, parameters in found.items()}
        print(json.dumps(data, indent=1))
    else:
        print("\n".join(_table(found)))


@command.command()
@which
@click.argument("component")
@click.argument("names", nargs=-1, required=True, metavar="PARAMETER...")
def get(which: str, component: str, names: tuple[str, ...]) -> None:
    """The values of parameters, a line each."""
    one = rcdeploy_running.find(which)
    whole = rcdeploy_running.meant(component, rcdeploy_running.components(one))
    with _proxies(one) as proxy_of:
        parameters = {p.name: p for p in _parameters(proxy_of, whole)}
    for name in names:
        if name not in parameters:
            hint = did_you_mean(name, parameters)
            _fail(f"`{component}` has no parameter `{name}`", hint)
        print(parameters[name].value)


@command.command("set")
@which
@click.argument("component")
@click.argument("changes", nargs=-1, required=True, metavar="PARAMETER=VALUE...")
@click.option("--save", is_flag=True, help="Keep what was changed live for the next start.")
def set_(which: str, component: str, changes: tuple[str, ...], *, save: bool) -> None:
    """Change live parameters, all of them or none."""
    from robocomp_dsl.runtime.component_interface import Refusal  # noqa: PLC0415 - loads numpy

    values = dict(map(_change, changes))
    one = rcdeploy_running.find(which)
    name = rcdeploy_running.meant(component, rcdeploy_running.components(one))
    with _proxies(one) as proxy_of:
        proxy = _reached(proxy_of, name)
        try:
            proxy.setParameters(values)
            where = proxy.saveParameters() if save else ""
        except Refusal as refusal:
            _fail(f"`{name}` refuses: {refusal.reason}")
    print(f"{name}: {', '.join(f'{k} = {v}' for k, v in values.items())}")
    if where:
        print(f"kept in {where}")


def _change(text: str) -> tuple[str, str]:
    name, sign, value = text.partition("=")
    if not sign or not name:
        raise click.UsageError(f"`{text}` is no change; write PARAMETER=VALUE, as in rate=20")
    return name.strip(), value


@contextmanager
def _proxies(one: folder.Running) -> Iterator[ProxyOf]:
    """Calls the `Component` interface of the components of a deployment."""
    from robocomp_dsl.deploy import reach  # noqa: PLC0415 - loads a middleware
    from robocomp_dsl.runtime.errors import MiddlewareError, Timeout  # noqa: PLC0415

    try:
        with reach.proxies(one.domain, PATIENCE_S) as proxy_of:
            yield proxy_of
    except Timeout as error:
        _fail(f"a component does not answer within {PATIENCE_S:g} s; is it stuck? ({error})")
    except MiddlewareError as error:
        _fail(str(error))


def _reached(proxy_of: ProxyOf, name: str) -> ComponentProxy:
    proxy = proxy_of(name)
    if not proxy.wait_for_server(PATIENCE_S):
        hint = "see `rcdeploy status`; components of other middlewares than zenoh are not reached"
        _fail(f"`{name}` does not answer within {PATIENCE_S:g} s", hint)
    return proxy


def _parameters(proxy_of: ProxyOf, name: str) -> list[ParameterInfo]:
    return list(_reached(proxy_of, name).getParameters())


def _table(found: dict[str, list[ParameterInfo]]) -> Iterator[str]:
    """A line for each parameter: component, name, value, what it takes, what it is."""
    rows = [
        (name, one.name, one.value, _takes(one), "live" if one.live else "", one.doc)
        for name, parameters in found.items()
        for one in parameters
    ]
    heads = ("COMPONENT", "PARAMETER", "VALUE", "TAKES", "", "")
    lines = [heads, *rows]
    widths = [max(len(line[i]) for line in lines) for i in range(len(heads))]
    for line in lines:
        cells = (text.ljust(width) for text, width in zip(line, widths, strict=True))
        yield "  ".join(cells).rstrip()
    yield from (f"{name} has no parameters" for name, parameters in found.items() if not parameters)


def _takes(one: ParameterInfo) -> str:
    unit = f" [{one.unit}]" if one.unit else ""
    if one.choices:
        return " | ".join(one.choices)
    bounds = f" {one.low}:{one.high}" if one.low or one.high else ""
    return f"{one.type}{bounds}{unit}"


def _data(one: ParameterInfo) -> dict[str, object]:
    return {
        key: getattr(one, key)
        for key in ("name", "value", "type", "unit", "live", "low", "high", "choices", "doc")
    }


def _fail(message: str, hint: str = "") -> Never:
    rcdeploy_running.fail(f"{message}; {hint}" if hint else message)

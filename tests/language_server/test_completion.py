"""Completion: offered and omitted items at a position."""

from __future__ import annotations

from contextlib import nullcontext

import pytest
from lsprotocol import types as lsp

from robocomp_dsl.hardware.device_manager.boards import board_kinds
from robocomp_dsl.hardware.device_manager.description import PHASES_WITH_ACTIONS, Verb
from robocomp_dsl.language_server.completion import complete_devices
from tests.language_server import project
from tests.language_server.editor_client import Editor, edited

IDSL = "module M\n{{\n    enum Mode {{ Slow, Fast }};\n    struct S {{ {} }};\n    {}\n}};\n"
CDSL = 'import "Laser.idsl";\nComponent c\n{{\n    Communications {{ {} }};\n    {}\n}};\n'
DDSL = (
    'import "reader.cdsl";\nimport "base.cdsl";\nDeployment d\n{{\n'
    "    host far {{ labels gpu; }};\n"
    "    component eye : reader {{ {} }};\n    component base;\n    {}\n}};\n"
)

ARM = "device arm : control_board; device zeroing : calibrator;"

# file, text with the place, what must be offered, what must not
CASES: list[tuple[str, str, set[str], set[str]]] = [
    ("a.idsl", "|", {"import", "module"}, {"struct", "interface"}),
    ("a.idsl", IDSL.format("", "|"), {"struct", "enum", "interface"}, {"import", "out"}),
    ("a.idsl", IDSL.format("flo|", ""), {"float", "Mode", "string"}, {"struct", "Slow"}),
    ("a.idsl", IDSL.format("float |", ""), set(), {"float", "Mode"}),
    ("a.idsl", IDSL.format("Mode m = |", ""), {"Slow", "Fast"}, {"Mode", "float"}),
    ("a.idsl", IDSL.format("float x [|", ""), {"mm", "rad"}, {"query"}),
    ("a.idsl", IDSL.format("", "interface I { [|"), {"command", "query", "publish"}, {"mm"}),
    ("a.idsl", IDSL.format("", "interface I { void f(|"), {"S", "out", "int"}, {"struct"}),
    ("a.idsl", IDSL.format("", "sequence<|"), {"S", "int", "Mode"}, {"out"}),
    ("a.idsl", 'import "Laser.idsl";\n' + IDSL.format("Scans::|", ""), {"Beam", "Scan"},
     {"Broken", "float"}),
    ("a.idsl", 'import "Laser.idsl";\n' + IDSL.format("", "interface I { void f() throws |"),
     {"Scans::Broken"}, {"Scans::Beam", "int"}),
    ("a.idsl", 'import "|', {"Laser.idsl", "IMU.idsl"}, {"a.idsl", "reader.cdsl"}),
    ("a.idsl", "// |", set(), {"import"}),
    ("c.cdsl", CDSL.format("requires |", ""), {"Laser", "IMU"}, {"language", "Beam"}),
    ("c.cdsl", CDSL.format("requires Laser, |", ""), {"Laser", "IMU"}, {"as"}),
    ("c.cdsl", CDSL.format("requires Laser |", ""), {"as"}, {"IMU", "language"}),
    ("c.cdsl", CDSL.format("requires Scans::|", ""), {"Laser"}, {"IMU", "Beam"}),
    ("c.cdsl", CDSL.format("|", ""), {"implements", "requires", "publishes"}, {"period"}),
    ("c.cdsl", CDSL.format("", "|"), {"language", "period", "middleware"}, {"requires", "no_gui"}),
    ("c.cdsl", CDSL.format("", "language |"), {"Python", "Cpp"}, {"period"}),
    ("c.cdsl", CDSL.format("", "middleware |"), {"zenoh", "inproc"}, {"Python"}),
    ("c.cdsl", CDSL.format("requires Laser(|", ""), {"zenoh", "inproc"}, {"IMU"}),
    ("c.cdsl", CDSL.format("requires Laser(zenoh, |", ""), {"inproc"}, {"IMU"}),
    ("c.cdsl", CDSL.format("requires Laser(zenoh), |", ""), {"IMU"}, {"inproc"}),
    ("c.cdsl", CDSL.format("", 'parameters "|";'), {"reader.pdsl"}, {"Laser.idsl"}),
    ("p.pdsl", "ComponentParams p\n{\n    rate |\n};\n", {"float", "int", "string"}, {"live"}),
    ("p.pdsl", "ComponentParams p\n{\n    rate float 5 |\n};\n", {"live"}, {"ComponentParams"}),
    ("p.pdsl", "ComponentParams p\n{\n    on bool |\n};\n", {"true", "false", "live"}, set()),
    ("d.ddsl", 'import "|', {"reader.cdsl", "base.cdsl"}, {"Laser.idsl"}),
    ("d.ddsl", DDSL.format("", "component x : |"), {"reader", "base"}, {"eye"}),
    ("d.ddsl", DDSL.format("", "component base on |"), {"far"}, {"reader"}),
    ("d.ddsl", DDSL.format("", "component base on |"), {"label"}, {"gpu"}),
    ("d.ddsl", DDSL.format("", "component base on label |"), {"gpu"}, {"far"}),
    ("d.ddsl", DDSL.format("", "group g on |"), {"far", "label"}, {"gpu"}),
    ("d.ddsl", DDSL.format("", "group g on label |"), {"gpu"}, {"far"}),
    ("d.ddsl", DDSL.format("place |", ""), {"by"}, {"far"}),
    ("d.ddsl", DDSL.format("place by load on |", ""), {"far", "label"}, {"gpu"}),
    ("d.ddsl", DDSL.format("place by load on far, |", ""), {"far"}, {"gpu"}),
    ("d.ddsl", DDSL.format("place by load on label |", ""), {"gpu"}, {"far"}),
    ("d.ddsl", DDSL.format("realtime |", ""), {"priority"}, {"far"}),
    ("d.ddsl", DDSL.format("|", ""), {"cores", "realtime", "files", "place"}, {"labels"}),
    ("d.ddsl", DDSL.format('files "|', ""), {"reader.cdsl", "base.cdsl"}, {"eye"}),
    ("d.ddsl", DDSL.format("", "host x { |"), {"address", "labels", "port", "user"}, {"cores"}),
    ("d.ddsl", DDSL.format("after |", ""), {"base", "eye"}, {"reader", "set"}),
    ("d.ddsl", DDSL.format("set |", ""), {"rate", "pid"}, {"gain"}),
    ("d.ddsl", DDSL.format("set pid.|", ""), {"gain"}, {"rate"}),
    ("d.ddsl", DDSL.format("restart |", ""), {"on-failure", "always", "never"}, set()),
    ("d.ddsl", DDSL.format("pre|", ""), {"prefix", "after", "context"}, {"connect"}),
    ("d.ddsl", DDSL.format("prefix |", "component x { prefix left; };"), {"left"}, {"eye"}),
    ("d.ddsl", DDSL.format("", "connect |"), {"eye", "base"}, {"reader"}),
    ("d.ddsl", DDSL.format("", "connect eye.|"), {"Laser"}, {"eye"}),
    ("d.ddsl", DDSL.format("", "connect eye.Laser -> base.|"), {"Laser"}, {"eye"}),
    ("d.ddsl", DDSL.format("", "connect base.|"), set(), {"Laser"}),
    ("d.ddsl", DDSL.format("middleware |", ""), {"zenoh", "inproc"}, {"eye"}),
    ("d.ddsl", DDSL.format("port |", ""), {"Laser"}, {"zenoh", "rate"}),
    ("d.ddsl", DDSL.format("port Laser over |", ""), {"zenoh"}, {"Laser"}),
    ("d.ddsl", DDSL.format("", "connect eye.Laser -> base.Laser over |"), {"zenoh"}, {"eye"}),
    ("d.ddsl", DDSL.format("", "connect eye.Laser -> base.Laser {| };"),
     {"keep", "latched", "monitor", "priority"}, {"set"}),
    ("d.ddsl", DDSL.format("", "connect eye.Laser -> base.Laser { keep |"), {"all", "last"},
     {"eye"}),
    ("d.ddsl", DDSL.format("", 'connect eye.Laser -> base.Laser { monitor "|'), {"limits.py"},
     {"reader.cdsl"}),
    ("d.ddsl", DDSL.format("", 'connect eye.Laser -> base.Laser { monitor "limits.py" |'),
     {"Limit"}, {"eye"}),
    ("d.ddsl", DDSL.format("", 'connect eye.Laser -> base.Laser { monitor "limits.py" Limit at |'),
     {"sender", "receiver"}, {"eye"}),
    ("d.ddsl", DDSL.format("", 'connect eye.Laser -> base.Laser { monitor "x.py" A on failure |'),
     {"bypass", "close"}, {"sender"}),
    ("d.ddsl", DDSL.format("", "extern old over |"), {"zenoh"}, {"eye"}),
    ("d.ddsl", DDSL.format("", 'extern old over zenoh at "x" |'), {"implements", "publishes"},
     {"eye"}),
    ("d.ddsl", DDSL.format("", 'extern old over zenoh at "x" implements |'), {"Laser"}, {"eye"}),
    ("d.ddsl", DDSL.format("", "extern old over x requires Laser; connect eye.Laser -> |"),
     {"old", "base"}, {"reader"}),
    ("d.ddsl", DDSL.format("", "extern old over x requires Laser; connect eye.Laser -> old.|"),
     {"Laser"}, {"old"}),
    ("d.ddsl", DDSL.format("", "arbitrate |"), {"base"}, {"reader"}),
    ("d.ddsl", DDSL.format("", "arbitrate base.|"), {"Laser"}, {"base"}),
    ("d.ddsl", DDSL.format("", "arbitrate base.Laser { from |"), {"eye"}, {"reader"}),
    ("d.ddsl", DDSL.format("", "|"), {"component", "connect", "host"}, {"set", "after"}),
    ("d.ddsl", DDSL.format("device arm : |", ""), {"control_board", "cartesian"}, {"eye"}),
    ("d.ddsl", DDSL.format("device arm : cartesian { set | };", ""), {"tip", "base"}, {"rate"}),
    ("d.ddsl", DDSL.format(f"{ARM} attach |", ""), {"arm", "zeroing"}, {"eye"}),
    ("d.ddsl", DDSL.format(f"{ARM} attach zeroing to |", ""), {"arm"}, {"eye"}),
    ("d.ddsl", DDSL.format(f"{ARM} on |", ""), {"startup", "interrupt1", "shutdown"}, {"far"}),
    ("d.ddsl", DDSL.format(f"{ARM} on startup level 5 |", ""), {"calibrate", "park"}, {"arm"}),
    ("d.ddsl", DDSL.format(f"{ARM} on startup level 5 park |", ""), {"arm"}, {"park", "eye"}),
    ("d.ddsl", DDSL.format(f"{ARM} on startup level 5 park arm by |", ""), {"zeroing"}, {"eye"}),
]  # fmt: skip


async def completion_items(editor: Editor, name: str, marked: str) -> dict[str, lsp.CompletionItem]:
    params = lsp.CompletionParams(**editor.at(name, marked))
    found = await editor.client.text_document_completion_async(params)
    assert isinstance(found, list | tuple)
    return {entry.label: entry for entry in found}


@pytest.mark.asyncio
async def test_completion_labels(editor: Editor) -> None:
    project.write(editor)
    editor.write("limits.py", "class Limit:\n    pass\n")
    for name, marked, expected_labels, unwanted in CASES:
        labels = set(await completion_items(editor, name, marked))
        assert expected_labels <= labels, (marked, expected_labels - labels, sorted(labels))
        assert not unwanted & labels, (marked, unwanted & labels)
        editor.close(name)


@pytest.mark.asyncio
async def test_completion_of_unimported_interface_adds_import(editor: Editor) -> None:
    project.write(editor)
    marked = CDSL.format("requires IM|", "")
    item = (await completion_items(editor, "c.cdsl", marked))["IMU"]
    assert isinstance(item.text_edit, lsp.TextEdit)
    edits = [item.text_edit, *(item.additional_text_edits or ())]
    after = edited(edits, marked.replace("|", ""))
    assert "requires IMU }" in after
    assert after.startswith('import "Laser.idsl";\nimport "IMU.idsl";\n')


@pytest.mark.asyncio
async def test_completion_item_has_documentation(editor: Editor) -> None:
    project.write(editor)
    item = (await completion_items(editor, "c.cdsl", CDSL.format("requires |", "")))["Laser"]
    assert isinstance(item.documentation, lsp.MarkupContent)
    assert "A planar laser." in item.documentation.value


@pytest.mark.asyncio
async def test_completion_uses_last_valid_check(editor: Editor) -> None:
    whole = "module M\n{\n    struct S { | };\n    enum Mode { Slow, Fast };\n};\n"
    broken = whole.replace("Slow, Fast };", "Slow, = (;")
    assert "Mode" not in await completion_items(editor, "fresh.idsl", broken)
    editor.open("a.idsl", whole.replace("|", ""))
    await editor.until("a.idsl", lambda _: True)
    editor.replace("a.idsl", broken.replace("|", ""))
    params = lsp.CompletionParams(**editor.place("a.idsl", broken))
    found = await editor.client.text_document_completion_async(params)
    assert isinstance(found, list | tuple)
    assert "Mode" in {entry.label for entry in found}


def test_device_kinds_match_simulators() -> None:
    hosted = board_kinds({}, nullcontext(), lambda *_: pytest.fail("no chain is asked for"))
    assert set(complete_devices.KINDS) == set(hosted)
    assert set(complete_devices.PHASES) == set(PHASES_WITH_ACTIONS)
    assert set(complete_devices.VERBS) == set(Verb)

"""Bridges in an editor: every feature, on one bridge with inputs, hubs, outputs and a service."""

from __future__ import annotations

import pytest
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcInvalidParams

from tests.language_server.editor_client import Editor, edited

pytestmark = pytest.mark.asyncio

ROBOT = """module Robot
{
    enum Mode { OFF, MANUAL };
    struct Speed { float advance [mm/s]; Mode mode; };
    interface Motors
    {
        bool setPower(bool on, float limit [A]);
        void setSpeed(Speed speed);
    };
};
"""
WHEELS = "Origin header\nfloat64[] position\nWheel[] wheels\n"
FILES = {
    "Robot.idsl": ROBOT,
    "robot_msgs/msg/Origin.msg": "string frame_id\n",
    "robot_msgs/msg/Wheel.msg": "float64 angle\n",
    "robot_msgs/msg/Wheels.msg": WHEELS,
    "robot_msgs/srv/Enable.srv": "bool data\n---\nbool success\n",
}
HEAD = """import "Robot.idsl";
import "robot_msgs/msg/Wheels.msg";
import "robot_msgs/srv/Enable.srv";
"""
ROVER = (
    HEAD
    + """
/** Joins the wheels. */
Bridge rover
{
    /** The left wheel. */
    input left : double[2] [deg] over yarp at "/left:o";
    input target : (double x [m], string label) over yarp at "/target:o";
    input wheels : robot_msgs::Wheels over ros2 at "/wheels";
    /** Swaps the sides. */
    function swap(double[] values [rad], double offset [rad]) -> double[] [rad];
    hub angles = left;
    output states : robot_msgs::Wheels over ros2 at "/states"
    {
        header.frame_id = target.label;
        position = swap(angles, 90 [deg]) to [rad];
        wheels = { { left[0] to [rad] } };
    };
    output copy : robot_msgs::Wheels over zenoh = wheels;
    output drive : Robot::Motors.setSpeed over ice at "motors:tcp -p 10002"
    {
        advance = target.x / 1 [s];
        mode = MANUAL;
    };
    service enable : robot_msgs::Enable over ros2 at "/enable"
    {
        call power : Robot::Motors.setPower over ice at "motors:tcp -p 10002"
        {
            on = request.data;
            limit = 2;
        };
        success = power.result;
    };
};
"""
)


def marked(word: str, number: int = 1) -> str:
    at = -1
    for _ in range(number):
        at = ROVER.index(word, at + 1)
    return ROVER[: at + 1] + "|" + ROVER[at + 1 :]


@pytest.fixture
def rover(editor: Editor) -> Editor:
    """An editor with the files that the bridge imports."""
    for name, text in FILES.items():
        editor.write(name, text)
    editor.write("rover.bdsl", ROVER)
    return editor


def within(items: str) -> str:
    return f"{HEAD}Bridge b {{\n{items}\n}};"


INPUTS = """input left : double[2] [deg] over yarp;
input target : (double x [m], string label) over yarp;
input wheels : robot_msgs::Wheels over ros2; function swap(double[] values [rad]) -> double[] [rad];
hub both = left, target.x;
"""
STATES = "output states : robot_msgs::Wheels over ros2 { "
DRIVE = "output drive : Robot::Motors.setSpeed over ice { "
ACTION = """action g : actionlib_msgs::Grasp over ros1 at "/g"
{ state hand : (double width [m], bool moving) over yarp; """
CALL = """service s : robot_msgs::Enable
{ call p : Robot::Motors.setPower over ice { on = request.data; limit = 1; }; """
COMPLETIONS: list[tuple[str, set[str], set[str]]] = [
    ("|", {"import", "Bridge"}, {"input"}),
    (
        within("|"),
        {"input", "hub", "output", "function", "service", "rate", "middleware"},
        {"item"},
    ),
    (within("middleware |"), {"zenoh", "yarp", "ros2"}, {"input"}),
    (within("input a : |"), {"double", "Robot::Speed", "robot_msgs::Wheels", "Motors"}, {"left"}),
    (within("input a : (double x, |"), {"double", "Robot::Speed"}, {"over"}),
    (within("input a : robot_msgs::|"), {"Wheels", "Origin", "Enable"}, {"Speed", "double"}),
    (within("input a : Robot::Motors.|"), {"setPower", "setSpeed"}, {"double"}),
    (within("input a : double |"), {"over", "at"}, {"double", "rate"}),
    (within("input a : double over |"), {"zenoh", "yarp"}, {"over"}),
    (
        within("input a : double over yarp { |"),
        {"stamp", "best_effort", "keep"},
        {"rate", "policy"},
    ),
    (within("input a : double { keep |"), {"all", "last"}, {"stamp"}),
    (within("input a : double { priority |"), {"high", "low"}, {"stamp"}),
    (within("input a : double { deadline 5 |"), {"ms", "s"}, {"stamp"}),
    (within("input a : robot_msgs::Wheels { stamp |"), {"header", "position"}, {"rate"}),
    (within("input a : robot_msgs::Wheels { stamp header.|"), {"frame_id"}, {"position"}),
    (within("input a : double [|"), {"deg", "rad", "m"}, set()),
    (within("rate 5 |"), {"Hz"}, {"ms"}),
    (within("function f(|"), {"double", "Robot::Speed"}, {"left"}),
    (within("function f(double a) -> |"), {"double"}, {"left"}),
    (within(INPUTS + "hub h = |"), {"left", "target", "both", "swap", "length"}, {"double"}),
    (within(INPUTS + "hub h = left, |"), {"left", "target", "wheels"}, {"policy"}),
    (within(INPUTS + "hub h = target.|"), {"x", "label"}, {"left"}),
    (within(INPUTS + "hub h = wheels.header.|"), {"frame_id"}, {"position"}),
    (within(INPUTS + "hub h = wheels.wheels[0].|"), {"angle"}, {"header"}),
    (within(INPUTS + "hub h = left { |"), {"policy", "max_age", "length"}, {"rate"}),
    (within(INPUTS + "hub h = left { policy |"), {"latest", "all", "synchronised"}, {"left"}),
    (within(INPUTS + "hub h = left { policy synchronised |"), {"within"}, {"left"}),
    (within(INPUTS + STATES + "|"), {"header", "position", "rate", "item"}, {"call", "left"}),
    (within(INPUTS + STATES + "header.|"), {"frame_id"}, {"position", "rate"}),
    (within(INPUTS + STATES + "wheels[0].|"), {"angle"}, {"header"}),
    (
        within(INPUTS + STATES + "position = |"),
        {"left", "both", "swap", "now", "counter"},
        {"header"},
    ),
    (within(INPUTS + STATES + "position = { left[0], |"), {"left", "target"}, {"header", "rate"}),
    (within(INPUTS + STATES + "position = { target.|"), {"x"}, {"left"}),
    (within(INPUTS + STATES + "position = swap(target.|"), {"x"}, {"left"}),
    (within(INPUTS + STATES + "position = left |"), {"to"}, {"left"}),
    (within(INPUTS + STATES + "position = left to [|"), {"rad", "deg"}, set()),
    (within(INPUTS + STATES + "item |"), {"left", "now"}, {"header"}),
    (within(INPUTS + DRIVE + "|"), {"advance", "mode"}, {"result"}),
    (within(INPUTS + DRIVE + "mode = |"), {"OFF", "MANUAL", "left"}, {"advance"}),
    (within(ACTION + "|"), {"command", "succeed", "timeout"}, {"rate", "left"}),
    (within(ACTION + "succeed when |"), {"goal", "hand", "now"}, {"left", "succeed"}),
    (within(ACTION + "succeed when hand.|"), {"width", "moving"}, {"left", "hand"}),
    (within(ACTION + "timeout 5 |"), {"ms", "s"}, {"hand"}),
    (within(CALL + "|"), {"success", "call"}, {"data", "rate", "depth"}),
    (within(CALL + "success = |"), {"request", "p", "true"}, {"left"}),
    (within(CALL + "success = p.|"), {"result"}, {"data"}),
    (within(CALL + "success = request.|"), {"data"}, {"success"}),
    (within(CALL.replace("on = request.data;", "|")), {"on", "limit"}, {"call", "rate"}),
    (within(CALL.replace("request.data", "request.|")), {"data"}, {"on"}),
    ('import "|', {"Robot.idsl", "robot_msgs/msg/Wheels.msg", "robot_msgs/srv/Enable.srv"}, set()),
]


async def test_completion_of_bdsl(rover: Editor) -> None:
    for text, expected_labels, unwanted in COMPLETIONS:
        params = lsp.CompletionParams(**rover.at("a.bdsl", text))
        found = await rover.client.text_document_completion_async(params)
        assert isinstance(found, list | tuple)
        labels = {entry.label for entry in found}
        assert expected_labels <= labels, (text, sorted(labels))
        assert not unwanted & labels, (text, unwanted & labels)


HOVERS = [
    ("left", 4, ['input left : double[2] [deg] over yarp at "/left:o";', "The left wheel."]),
    ("target.label", 1, ["(double x [m], string label)", "string label"]),
    ("label;", 1, ["string label"]),
    ("swap", 2, ["function swap(double[] values [rad], double offset [rad]) -> double[] [rad];",
     "Swaps the sides."]),
    ("angles", 2, ["hub angles", "2 × double [deg]", "policy latest", "to [rad]", "0.0174533"]),
    ("wheels;", 1, ["input wheels : robot_msgs::Wheels", "struct robot_msgs::Wheels"]),
    ("position =", 1, ["double[] position"]),
    ("MANUAL", 1, ["MANUAL = 1"]),
    ("power.result", 1, ["call power(bool on, float limit [A]) -> bool"]),
    ("result", 1, ["bool setPower(bool on, float limit [A]);"]),
    ("rover\n", 1, ["Bridge rover", "input left", "service enable", "Joins the wheels."]),
    ("yarp", 1, ["**yarp**: "]),
    ("[0] to", 1, ["converts [deg] to [rad]", "× 0.0174533"]),
    ("Enable over", 1, ["Enable_Request"]),
]  # fmt: skip


async def test_hover_of_bdsl(rover: Editor) -> None:
    for word, number, parts in HOVERS:
        params = lsp.HoverParams(**rover.at("rover.bdsl", marked(word, number)))
        found = await rover.client.text_document_hover_async(params)
        assert found is not None, word
        assert isinstance(found.contents, lsp.MarkupContent)
        for part in parts:
            assert part in found.contents.value, (word, found.contents.value)


async def test_definition_and_references_in_bdsl(rover: Editor) -> None:
    for word, number, name, line in [
        ("angles, 90", 1, "rover.bdsl", 14),
        ("swap(angles", 1, "rover.bdsl", 13),
        ("label;", 1, "rover.bdsl", 10),
        ("Wheels over", 2, "robot_msgs/msg/Wheels.msg", 1),
        ("frame_id", 1, "robot_msgs/msg/Origin.msg", 1),
        ("advance", 1, "Robot.idsl", 4),
        ("MANUAL", 1, "Robot.idsl", 3),
        ("setPower", 1, "Robot.idsl", 7),
        ("limit", 1, "Robot.idsl", 7),
        ("data", 1, "robot_msgs/srv/Enable.srv", 1),
        ("power.result", 1, "rover.bdsl", 29),
        ("Robot.idsl", 1, "Robot.idsl", 1),
    ]:
        params = lsp.DefinitionParams(**rover.at("rover.bdsl", marked(word, number)))
        found = await rover.client.text_document_definition_async(params)
        assert isinstance(found, list | tuple), word
        places = [(item.uri, item.range.start.line + 1) for item in found]
        assert places == [(rover.uri(name), line)], word
    place = rover.place("rover.bdsl", marked("target", 1))
    for declared, lines in ((True, [10, 17, 24]), (False, [17, 24])):
        context = lsp.ReferenceContext(include_declaration=declared)
        references = await rover.client.text_document_references_async(
            lsp.ReferenceParams(context, **place)
        )
        assert sorted(item.range.start.line + 1 for item in references or ()) == lines


async def test_references_of_idsl_field_include_bridge(rover: Editor) -> None:
    rover.open("rover.bdsl", ROVER)
    text = ROBOT.replace("advance", "ad|vance")
    context = lsp.ReferenceContext(include_declaration=False)
    params = lsp.ReferenceParams(context, **rover.at("Robot.idsl", text))
    found = await rover.client.text_document_references_async(params)
    assert [item.uri for item in found or ()] == [rover.uri("rover.bdsl")]


async def rename(editor: Editor, word: str, new: str) -> dict[str, list[lsp.TextEdit]]:
    params = lsp.RenameParams(new_name=new, **editor.at("rover.bdsl", marked(word)))
    found = await editor.client.text_document_rename_async(params)
    assert found is not None
    return {uri: list(edits) for uri, edits in (found.changes or {}).items()}


async def test_rename_in_bdsl(rover: Editor) -> None:
    here = rover.uri("rover.bdsl")
    for word, new in [("angles", "joints"), ("swap", "flip"), ("drive", "move"), ("power", "p")]:
        changes = await rename(rover, word, new)
        assert list(changes) == [here]
        assert edited(changes[here], ROVER) == ROVER.replace(word, new), word
    changes = await rename(rover, "advance", "speed")
    assert set(changes) == {here, rover.uri("Robot.idsl")}
    assert "speed = target.x" in edited(changes[here], ROVER)
    assert "float speed [mm/s]" in edited(changes[rover.uri("Robot.idsl")], ROBOT)
    changes = await rename(rover, "setPower", "enable")
    assert "success = power.result;" in edited(changes[here], ROVER)


@pytest.mark.parametrize(
    ("word", "new", "why"),
    [
        ("angles", "left", "another input is named `left`"),
        ("angles", "hub", "`hub` is a keyword"),
        ("angles", "a b", "`a b` is not a valid name"),
        ("frame_id", "frame", "ROS definition"),
    ],
)
async def test_rename_rejects_invalid_names_of_bridge(
    rover: Editor, word: str, new: str, why: str
) -> None:
    with pytest.raises(JsonRpcInvalidParams, match=why):
        await rename(rover, word, new)


async def test_document_symbols_of_bdsl(rover: Editor) -> None:
    document = lsp.TextDocumentIdentifier(rover.open("rover.bdsl", ROVER))
    params = lsp.DocumentSymbolParams(document)
    (found,) = await rover.client.text_document_document_symbol_async(params) or ()
    assert isinstance(found, lsp.DocumentSymbol)
    children = list(found.children or ())
    assert (found.name, children[0].name, children[0].detail) == (
        "rover",
        "left",
        "double[2] [deg] over yarp",
    )
    assert (children[-1].name, children[-1].detail) == ("enable", "robot_msgs::Enable over ros2")
    (call,) = children[-1].children or ()
    assert (call.name, call.detail) == ("power", "Robot::Motors.setPower over ice")


async def test_tokens_folding_links_and_symbols_of_bdsl(rover: Editor) -> None:
    document = lsp.TextDocumentIdentifier(rover.open("rover.bdsl", ROVER))
    tokens = await rover.client.text_document_semantic_tokens_full_async(
        lsp.SemanticTokensParams(document)
    )
    assert tokens is not None
    kinds = {rover.legend[kind] for kind in tokens.data[3::5]}
    assert {"class", "variable", "function", "property", "method", "enumMember"} <= kinds
    folds = await rover.client.text_document_folding_range_async(lsp.FoldingRangeParams(document))
    assert {(fold.start_line, fold.end_line) for fold in folds or ()} >= {(0, 2), (29, 31)}
    links = await rover.client.text_document_document_link_async(lsp.DocumentLinkParams(document))
    names = ("Robot.idsl", "robot_msgs/msg/Wheels.msg", "robot_msgs/srv/Enable.srv")
    assert [link.target for link in links or ()] == [rover.uri(name) for name in names]
    symbols = await rover.client.workspace_symbol_async(lsp.WorkspaceSymbolParams("angles"))
    assert [symbol.name for symbol in symbols or ()] == ["angles"]


async def test_inlay_hints_show_unit_conversions(rover: Editor) -> None:
    document = lsp.TextDocumentIdentifier(rover.open("rover.bdsl", ROVER))
    whole = lsp.Range(lsp.Position(0, 0), lsp.Position(len(ROVER.splitlines()), 0))
    found = await rover.client.text_document_inlay_hint_async(lsp.InlayHintParams(document, whole))
    shown = {(hint.position.line + 1, str(hint.label)) for hint in found or ()}
    assert shown == {
        (18, "to [rad]: × 0.0174533"),
        (19, "× 0.0174533"),
        (24, "to [mm/s]: × 1000"),
    }
    first = min(found or (), key=lambda hint: hint.position.line)
    assert first.tooltip == "converts [deg] to [rad]"


async def test_signature_help_of_bdsl(rover: Editor) -> None:
    for text, label, number in [
        ("swap(|angles", "function swap(", 0),
        ("swap(angles, |90", "function swap(", 1),
        ("swap({ left[0], left[1] }, |90", "function swap(", 1),
        ("length(|angles", "length(x)", 0),
    ]:
        written = ROVER.replace("swap(angles, 90", text)
        params = lsp.SignatureHelpParams(**rover.at("rover.bdsl", written))
        found = await rover.client.text_document_signature_help_async(params)
        assert found is not None, text
        assert found.signatures[0].label.startswith(label)
        assert found.active_parameter == number, text
    params = lsp.SignatureHelpParams(**rover.at("rover.bdsl", marked("header")))
    assert await rover.client.text_document_signature_help_async(params) is None


async def test_quick_fix_and_diagnostics_of_bdsl(rover: Editor) -> None:
    text = ROVER.replace("target.label", "targt.label")
    uri = rover.open("rover.bdsl", text)
    findings = await rover.until("rover.bdsl", bool)
    assert ["targt" in finding.message for finding in findings] == [True]
    context = lsp.CodeActionContext(findings)
    document = lsp.TextDocumentIdentifier(uri)
    found = await rover.client.text_document_code_action_async(
        lsp.CodeActionParams(document, findings[0].range, context)
    )
    actions = [action for action in found or () if isinstance(action, lsp.CodeAction)]
    changes = [action.edit.changes for action in actions if action.edit and action.edit.changes]
    assert any(edited(list(edits[uri]), text) == ROVER for edits in changes)


async def test_code_lens_generates_bridge(rover: Editor) -> None:
    text = """Bridge doubled
{
    input left : double over yarp at "/left:o";
    output twice : double over yarp at "/twice:i" = left * 2;
};
"""
    rover.write("doubled.bdsl", text)
    document = lsp.TextDocumentIdentifier(rover.open("doubled.bdsl", text))
    (lens,) = await rover.client.text_document_code_lens_async(lsp.CodeLensParams(document)) or ()
    assert lens.command is not None
    assert lens.command.title == "generate bridge"
    params = lsp.ExecuteCommandParams(lens.command.command, list(lens.command.arguments or ()))
    assert await rover.client.workspace_execute_command_async(params) is True
    assert (rover.folder / "specificworker.py").is_file()

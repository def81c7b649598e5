"""A misspelled declaration: one error there, whose fix renames it and whose notes are the uses."""

from __future__ import annotations

from pathlib import Path

import pytest

from benchmarks.token_faults import apply, find_errors

IDSL = """\
module M
{
    enum Mode { Idle, Moving };
    struct Point3D { double x; };
    sequence<Point3D> Points;
    exception Lost { string what; };
    interface Finder
    {
        Points find(Point3D near) throws Lost;
        Mode mode() throws Lost;
    };
};
"""
SMDSL = """\
Machine
{
    initial_state Waiting;
    states Busy;
    end_state Over;
    transitions { Waiting => Busy on started; Busy => Waiting, Over; };
};
:Busy { initial_state Left; states Right; transitions { Left => Right; }; };
"""
BDSL = """\
bridge b
{
    input joints : double[2] [deg] over yarp at "/arm/state:o";
    function scale(double[2] angles [deg]) -> double[2] [deg];
    hub newest = joints { length 2; };
    output first : double [deg] over yarp at "/first:i" = joints[0];
    output second : double[2] [deg] over yarp at "/second:i" = scale(joints);
    output third : double[2] [deg] over yarp at "/third:i" = newest;
    output fourth : (double left [deg], double right [deg]) over yarp at "/fourth:i"
    {
        left = joints[0];
        right = joints[1];
    };
};
"""
CASES = [
    (".idsl", IDSL, "struct Point3D", "struct Pont3D", 2),
    (".idsl", IDSL.replace("Points", "Point3Ds"), "struct Point3D", "struct Pont3D", 2),
    (".idsl", IDSL, "enum Mode", "enum Mdoe", 1),
    (".idsl", IDSL, "> Points", "> Poinnts", 1),
    (".idsl", IDSL, "exception Lost", "exception Losst", 2),
    (".smdsl", SMDSL, "initial_state Waiting", "initial_state Waitign", 2),
    (".smdsl", SMDSL, "states Busy", "states Buzsy", 3),
    (".smdsl", SMDSL.replace("Busy", "Ill"), "states Ill", "states Inl", 3),
    (".smdsl", SMDSL, "end_state Over", "end_state Ovver", 1),
    (".smdsl", SMDSL, "states Right", "states Rigth", 1),
    (".bdsl", BDSL, "input joints", "input jonits", 5),
    (".bdsl", BDSL, "function scale", "function scael", 1),
    (".bdsl", BDSL, "hub newest", "hub newwest", 1),
    (".bdsl", BDSL, "double left", "double leftt", 1),
]


@pytest.mark.parametrize(("suffix", "text", "right", "wrong", "uses"), CASES)
def test_misspelled_declaration_is_one_error_with_its_uses(
    suffix: str, text: str, right: str, wrong: str, uses: int, tmp_path: Path
) -> None:
    path = tmp_path / f"x{suffix}"
    assert not find_errors(path, text)
    changed = text.replace(right, wrong, 1)
    (error,) = find_errors(path, changed)
    declared, name = (words.rpartition(" ")[2] for words in (wrong, right))
    assert error.span.start == changed.index(wrong) + len(wrong) - len(declared)
    assert error.message == f"`{declared}` is declared, but `{name}` is used"
    assert [note.span.text for note in error.notes] == [name] * uses
    assert error.fix
    assert apply(changed, error.fix) == text


@pytest.mark.parametrize(
    ("right", "wrong", "names"),
    [
        ("find(Point3D", "find(Pont3D", ["Pont3D"]),  # the declaration has another use
        ("Mode mode", "Mde mode", ["Mde"]),  # `Mde` is less like a word than `Mode`
        ("struct Point3D", "struct Other", ["Point3D", "Point3D"]),  # nothing is similar
        ("struct Point3D { double x; };", "struct Point3A {}; struct Point3B {};", ["Point3D"] * 2),
    ],
)
def test_unknown_name_stays_at_use(
    right: str, wrong: str, names: list[str], tmp_path: Path
) -> None:
    errors = find_errors(tmp_path / "x.idsl", IDSL.replace(right, wrong, 1))
    assert [error.span.text for error in errors] == names


def test_comment_is_no_use_of_declaration(tmp_path: Path) -> None:
    text = IDSL.replace("struct Point3D", "/** A Pont3D. */ struct Pont3D /* Pont3D */")
    (error,) = find_errors(tmp_path / "x.idsl", text)
    assert error.message == "`Pont3D` is declared, but `Point3D` is used"


def test_more_uses_than_notes_are_counted(tmp_path: Path) -> None:
    fields = "".join(f"Point3D p{number}; " for number in range(12))
    text = IDSL.replace("sequence<", f"struct All {{ {fields}}}; sequence<")
    (error,) = find_errors(tmp_path / "x.idsl", text.replace("struct Point3D", "struct Pont3D"))
    assert len(error.notes) == 8
    assert error.help == "6 more uses are not shown"


BODY = "Component body { Communications { implements Laser; }; };"
REFLEX = (
    "Component reflex { Communications { requires Laser as first; requires Laser as second; }; };"
)
DDSL = """\
import "body.cdsl";
import "reflex.cdsl";
Deployment demo
{
    host desk { address "localhost"; labels gpu; };
    component hand : body on desk;
    component foot : body on label gpu { after hand; };
    group arm
    {
        component body;
        export Laser from body as Range;
    };
    component reflex;
    connect reflex.first -> hand.Laser;
    connect reflex.second -> arm.Range;
};
"""


@pytest.fixture
def deployment(tmp_path: Path) -> Path:
    for name, text in (("body", BODY), ("reflex", REFLEX)):
        (tmp_path / f"{name}.cdsl").write_text(f'import "Laser.idsl";\n{text}\n')
    return tmp_path / "demo.ddsl"


DDSL_CASES = [
    ("component hand", "component hnad", "`hnad` is declared, but `hand` is used", ["hand"] * 2),
    ("host desk", "host deskk", "`deskk` is declared, but `desk` is used", ["desk"]),
    ("labels gpu", "labels gppu", "`gppu` is declared, but `gpu` is used", ["gpu"]),
    ("group arm", "group armm", "`armm` is declared, but `arm` is used", ["arm"]),
    ("as Range", "as Ragne", "`Ragne` is declared, but `Range` is used", ["Range"]),
    ("component reflex", "component refllex", "component `refllex` is not declared by any import",
     ["reflex", "reflex", "reflex"]),
    ("connect reflex.first", "connect reflx.first", "there is no component `reflx`", []),
    ("-> hand.Laser", "-> hnad.Laser", "there is no component `hnad`", []),
    ("Laser from body", "Lasr from body", "`arm-body` has no port `Lasr`", ["body"]),
]  # fmt: skip


@pytest.mark.parametrize(("right", "wrong", "message", "uses"), DDSL_CASES)
def test_misspelled_name_of_deployment_is_one_error(
    right: str, wrong: str, message: str, uses: list[str], deployment: Path
) -> None:
    assert not find_errors(deployment, DDSL)
    changed = DDSL.replace(right, wrong, 1)
    (error,) = find_errors(deployment, changed)
    assert error.message.startswith(message)
    assert [note.span.text for note in error.notes][-len(uses) or len(error.notes) :] == uses
    assert error.fix
    assert apply(changed, error.fix) == DDSL


DEVICES = """\
import "body.cdsl";
Deployment demo
{
    component body
    {
        device arm : control_board;
        device hand : cartesian;
        device zeroing : calibrator;
        attach zeroing to arm;
        attach hand to arm;
        on startup level 5 calibrate arm by zeroing;
        on startup level 6 attach hand;
    };
};
"""


@pytest.mark.parametrize(
    ("right", "wrong", "uses"),
    [
        ("device hand", "device haand", 2),
        ("device zeroing", "device zeroig", 2),
        ("attach zeroing to arm", "attach zeroing to amr", 0),
        ("attach hand to", "attach hadn to", 0),
    ],
)
def test_misspelled_device_is_one_error(
    right: str, wrong: str, uses: int, deployment: Path
) -> None:
    assert not find_errors(deployment, DEVICES)
    changed = DEVICES.replace(right, wrong, 1)
    (error,) = find_errors(deployment, changed)
    assert len(error.notes) == uses
    assert error.fix
    assert apply(changed, error.fix) == DEVICES

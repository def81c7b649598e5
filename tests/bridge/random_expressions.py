"""Random outputs of a bridge, most of them with values of a fitting type."""

from __future__ import annotations

from random import Random

HEADER = """\
import "geometry_msgs/msg/PoseStamped.msg";
import "sensor_msgs/msg/JointState.msg";

Bridge random_values
{
    rate 10 Hz;
    input number_in : double over yarp at "/number:o";
    input angle : float [deg] over yarp at "/angle:o";
    input distance : double [mm] over yarp at "/distance:o";
    input whole : int over yarp at "/whole:o";
    input large : long [ms] over yarp at "/large:o";
    input small : byte over yarp at "/small:o";
    input word : string over yarp at "/word:o";
    input digits : string over yarp at "/digits:o";
    input flag : bool over yarp at "/flag:o";
    input angles : double[] [deg] over yarp at "/angles:o";
    input pair : double[2] [rad] over yarp at "/pair:o";
    input wholes : long[3] over yarp at "/wholes:o";
    input floats : float[] over yarp at "/floats:o";
    input words : string[2] over yarp at "/words:o";
    input flags : bool[] over yarp at "/flags:o";
    input shape : (double x [m], int count, string name, bool on) over yarp at "/shape:o";
    input shapes : (double x, double y)[] over yarp at "/shapes:o";
    input pose : geometry_msgs::PoseStamped over ros2 at "/pose";
    input joints : sensor_msgs::JointState over ros2 at "/joints";

    function twice(double[] numbers [rad]) -> double[] [rad];
    function pick(double[] numbers, int index) -> double;
    function label(string name, double number) -> string;

    hub both = angles, pair;
    hub fixed = pair, angle;
    hub counts = wholes, whole;
    hub mixed = pair, word, flag;
    hub poses = pose.pose.position;
"""

TARGETS = (
    *("double", "double [rad]", "double [m]", "float", "int", "long", "long [ns]", "byte", "short"),
    *("string", "bool", "double[]", "double[] [rad]", "float[]", "long[]", "int[]", "string[]"),
    *("double[3]", "bool[]", "(double a, double b)", "(double a, string b, bool c)[]"),
    *("(double[] a, (double c, int d) b)", "double[][]", "(double a [s], long b [ms])"),
)
NUMBERS = (
    *("number_in", "angle", "distance", "whole", "large", "small", "counter", "shape.x"),
    *("shape.count", "pair[0]", "pair[1]", "angles[0]", "wholes[2]", "floats[0]", "fixed[2]"),
    *("pose.pose.position.x", "joints.position[0]", "joints.header.stamp.sec", "counts[3]"),
    *("shapes[0].y", "mixed[1]", "poses[2]", "both[0]", "number(digits)", "number(flag)"),
    *("length(words)", "length(word)", "length(angles)", "pick(angles to [deg], 0)", "3", "2.5"),
    *("90 [deg]", "1.5 [m]", "(now - stamp(pose))", "now to [s]", "now to [ns]"),
)
LISTS = (
    *("angles", "pair", "wholes", "floats", "both", "fixed", "counts", "joints.position"),
    *("wholes[2,0]", "angles[0:2]", "wholes[1:]", "both[1:]", "fixed[0,2]", "twice(angles)"),
    *("number(words)", "number(flags)", "number(wholes)", "pose.pose.position", "poses", "{}"),
)
OTHERS = (
    *("word", "digits", "shape.name", "words[1]", "mixed[2]", "joints.name", "joints.name[0]"),
    *("flag", "shape.on", "mixed[3]", "flags", "words", "true", '"text"', "text(number_in)"),
    *("text(flag)", "text(now)", "text(whole)", "label(word, 1)", "now", "stamp(joints)"),
    *("pose.header.stamp", "shape", "shapes", "mixed", "pose.header", "pose"),
)


def random_output(random: Random, index: int) -> str:
    """An output with a random value; most have one that fits."""
    if random.random() < 0.15:
        return _ros_output(random, index)
    target = random.choice(TARGETS)
    value = _value_for(target, random)
    return f'    output out{index} : {target} over yarp at "/out{index}:i" = {value};'


def _ros_output(random: Random, index: int) -> str:
    fields = {
        "header.stamp": random.choice(("now", "stamp(pose)", "pose.header.stamp", "1.5 [s]")),
        "header.frame_id": _text(random),
        "name": random.choice(("{}", "words", "joints.name", '{ "a", word }')),
        "position": _list(random, 2),
        "velocity": _list(random, 1),
        "effort": f"{{ {_number(random, 2)}, {_number(random, 1)} }}",
    }
    lines = " ".join(f"{path} = {value};" for path, value in fields.items())
    return (
        f'    output out{index} : sensor_msgs::JointState over ros2 at "/out{index}" {{ {lines} }};'
    )


def _value_for(target: str, random: Random) -> str:
    if random.random() < 0.05:
        return random.choice(OTHERS)
    whole = target.split(maxsplit=1)[0].strip("[3]") in ("int", "long", "byte", "short")
    if target.startswith("(double a, double b)"):
        return f"{{ {_number(random, 2)}, {_number(random, 2)} }}"
    if target.startswith("(double a, string"):
        item = f"{{ {_number(random, 1)}, {_text(random)}, {random.choice(('flag', 'true'))} }}"
        return f"{{ {item}, {item} }}"
    if target.startswith("(double[]"):
        return f"{{ {_list(random, 1)}, {{ {_number(random, 1)}, counter }} }}"
    if target.startswith("(double a [s]"):
        return random.choice(("{ now, now }", "{ now - stamp(pose), stamp(pose) }"))
    if target == "double[][]":
        return f"{{ {_list(random, 1)}, {{ 1, {_number(random, 1)} }} }}"
    if target.startswith("string"):
        is_list = target.endswith("]")
        return random.choice(("words", "{ word, digits }")) if is_list else _text(random)
    if target.startswith("bool"):
        return random.choice(("flags", "{ flag, true }") if "]" in target else ("flag", "shape.on"))
    value = _list(random, 2) if "[]" in target or "[3]" in target else _number(random, 3)
    return f"number({value})" if whole and random.random() < 0.7 else value


def _text(random: Random) -> str:
    return random.choice(("word", '"text"', "text(number_in)", "text(flag)", "label(word, 1)"))


def _number(random: Random, depth: int) -> str:
    if depth == 0 or random.random() < 0.4:
        return random.choice(NUMBERS)
    operator = random.choice("+-*/")
    left, right = _number(random, depth - 1), _number(random, depth - 1)
    return random.choice((f"({left} {operator} {right})", f"-({left})", f"(({left}) to [m])", left))


def _list(random: Random, depth: int) -> str:
    if depth == 0 or random.random() < 0.5:
        return random.choice(LISTS)
    operator = random.choice("+-*/")
    first, second = _list(random, depth - 1), _number(random, 1)
    return random.choice(
        (
            f"({first} {operator} {second})",
            f"({second} {operator} {first})",
            f"({first} {operator} {_list(random, 0)})",
            f"({first} to [rad])",
            f"{{ {second}, {_number(random, 1)} }}",
            f"-{first}",
        )
    )

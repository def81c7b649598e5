"""RC78x: actions of bridges."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

ACTION_TYPE = Code(
    "RC780",
    Severity.ERROR,
    "action without an action type, address or suitable middleware",
    """\
The type of an action is an imported `.action` file. Only `ros1` carries actions, and `at` is the
name of the action: its five topics are below it.

Wrong:

    action grasp : std_msgs::Float64 over zenoh { … };

Right:

    import "my_msgs/action/Grasp.action";
    action grasp : my_msgs::Grasp over ros1 at "/grasp" { … };
""",
)

INCOMPLETE_ACTION = Code(
    "RC781",
    Severity.ERROR,
    "incomplete action",
    """\
An action sends at least one command for a goal, receives at least one state, and has a condition
under which the goal has succeeded. Without one of them no goal would ever be reached.

Wrong:

    action grasp : my_msgs::Grasp over ros1 at "/grasp"
    {
        command close : (double width [m]) over yarp at "/hand:i" { width = goal.width; };
    };

Right:

    action grasp : my_msgs::Grasp over ros1 at "/grasp"
    {
        command close : (double width [m]) over yarp at "/hand:i" { width = goal.width; };
        state hand : (double width [m]) over yarp at "/hand:o";
        succeed when hand.width < 0.02 [m];
    };
""",
)

CONDITION_TYPE = Code(
    "RC782",
    Severity.ERROR,
    "condition that cannot be true or false",
    """\
A condition is a bool, or compares two numbers, strings, bools or enumerators. `<`, `<=`, `>` and
`>=` compare numbers only. Units are converted. `and` joins conditions; for "or" write a second
statement.

Wrong:

    succeed when hand.width;

Right:

    succeed when hand.width < 0.02 [m];
""",
)

ACTION_FIELD = Code(
    "RC783",
    Severity.ERROR,
    "assignment to no part of an action",
    """\
An action assigns fields of its feedback and of its result. Those of a command are assigned in the
braces of the command.

Wrong:

    width = hand.width;

Right:

    feedback.width = hand.width;
""",
)

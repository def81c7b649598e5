"""The findings of this stage."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

NO_TARGET = Code(
    "RC601",
    Severity.ERROR,
    "nothing is generated for this language",
    """The component says `language Cpp;` or another language that there is no generator for yet.
There is one for Python. Either write `language Python;` into the CDSL file, or leave it as it is
and ask for Python on the command line:

    rcgen component robot.cdsl --language python

The generated component talks to components of any language through its middleware.""",
)

MISSING_METHOD = Code(
    "RC611",
    Severity.WARNING,
    "an operation or state had no method in the user's class",
    """The component implements or subscribes to an interface, or has a state machine, and
`specificworker.py` had no method for one of its operations or states. rcgen puts a stub behind
the last statement of the class, and the imports it needs behind yours; nothing else of the
file is touched. Put your code into the stub:

    def Speech_say(self, req: DatasayReq) -> tuple[int, DatasayResp]:
        return 0, DatasayResp()

Until you do, a caller gets `RemoteError`, and a message of a topic is dropped.""",
)

STALE_METHOD = Code(
    "RC614",
    Severity.WARNING,
    "a method belongs to something that is gone",
    """An operation was removed from its interface, a port from the component, or a state from its
state machine; the method that served it is still in `specificworker.py`. Nothing calls it. If
the operation was renamed, a stub with the new name is at the end of the class: move your code
there. rcgen never deletes code of yours; when you have deleted the method, this is not said
any more.""",
)

CHANGED_SIGNATURE = Code(
    "RC615",
    Severity.WARNING,
    "the signature of a method has changed",
    """The operation has other inputs or results than the method was written for. Both signatures
are shown, the one in your file and the one there should be:

    old: def Speech_say(self, text: str) -> int
    new: def Speech_say(self, text: str, loud: bool) -> int

Change the method; rcgen leaves it as it is. Parameters that you named or annotated in a way of your
own are not reported, as long as the call works.""",
)

UNKNOWN_PARAMETER = Code(
    "RC616",
    Severity.WARNING,
    "the code uses a parameter that there is not",
    """`self.params.<name>` names no parameter of the PDSL file: it was renamed or removed there, or
it is misspelt. The line raises `AttributeError` when it runs.""",
)

UNKNOWN_OPERATION = Code(
    "RC617",
    Severity.WARNING,
    "the code calls an operation that there is not",
    """`self.<port>_proxy.<operation>` names no operation of the interface: it was renamed or
removed in the IDSL file, or it is misspelt. The line raises `AttributeError` when it runs.""",
)

UNKNOWN_EVENT = Code(
    "RC624",
    Severity.WARNING,
    "the code names an event or a state that the machine has not",
    """`self.machine.go("<event>")` or `self.machine.is_in("<state>")` names nothing of the state
machine: it was renamed or removed in the SMDSL or SCXML file, or it is misspelt. The line raises
`UnknownEvent` when it runs.""",
)

MERGED = Code(
    "RC618",
    Severity.NOTE,
    "a file of yours was merged with its new output",
    """`README.md` and `etc/config.yaml` are written once and then yours. What the descriptions say
of them has changed, you have changed them too, and the changes are in different places: both are in
the file now. `.rcgen/pristine` holds the output without your changes; keep `.rcgen` under version
control, for it is what the next merge starts from.""",
)

NOT_MERGED = Code(
    "RC619",
    Severity.WARNING,
    "a file of yours could not be merged with its new output",
    """You and rcgen changed the same lines of a file that is yours. It stays as it is. The folder
`.rcgen/conflicts` holds what a merge gives, with your lines, those before, and the new ones between
conflict markers: take what you need from there.""",
)

BROKEN_RECORD = Code(
    "RC620",
    Severity.WARNING,
    "the record of the last generation cannot be read",
    """`.rcgen/methods.json` holds the methods and signatures of the last generation; with it rcgen
knows which methods of yours are stale and whose signatures have changed. It is damaged, for example
by conflict markers of a merge. It is written anew from the descriptions as they are now.""",
)

NO_WORKER = Code(
    "RC612",
    Severity.WARNING,
    "the user's file has no class `SpecificWorker`",
    """`main.py` runs the class `SpecificWorker` of `specificworker.py`. The file exists, so rcgen
left it alone, but the class is not in it:

    from generated.genericworker import GenericWorker

    class SpecificWorker(GenericWorker):
        ...

If the file should be made anew, move it away and run rcgen again.""",
)

UNREADABLE_WORKER = Code(
    "RC613",
    Severity.WARNING,
    "the user's file could not be examined",
    """`specificworker.py` has a syntax error or is not a text, so it is not known which operations
it implements. rcgen left it as it is. The component does not start before it is mended.""",
)


RENAMED_IN_EXPORT = Code(
    "RC621",
    Severity.WARNING,
    "a name is spelled differently in the exported files",
    """The format that the interface is exported to does not allow this name, or takes it for the
same as another one: Slice and ROS 2 do not tell `Pose` from `pose`, and Slice keeps names that
begin with `Ice` or end in `Prx`, `Ptr`, `Helper` or `Holder` for itself.

Fields and parameters have no names on the wire, so a new one only matters to who writes code with
it. Ice sends the names of modules, interfaces, operations and exceptions: who was generated from
the exported file does not understand who uses the old name. Choose a name in the IDSL file that
all formats can keep:

    struct IceCream { int scoops; };      wrong for Slice
    struct Gelato { int scoops; };        right""",
)

RESHAPED_IN_EXPORT = Code(
    "RC622",
    Severity.WARNING,
    "a type has another shape in the exported files",
    """The format that the interface is exported to has no such type. Slice has no struct without
fields; it gets one that means nothing. Bytes that were written with one shape cannot be read with
the other.

    struct Nothing { };                   wrong for Slice
    struct Nothing { bool unused; };      right: the same everywhere""",
)

NOT_EXPORTABLE = Code(
    "RC623",
    Severity.ERROR,
    "the format cannot express this",
    """The format that the interface is exported to has no way to say this, and a guess would mean
something else. Slice has no negative values in enumerations:

    enum Level { Low = -1, High };        wrong for Slice
    enum Level { Low, High };             right""",
)

NO_SIMULATION = Code(
    "RC631",
    Severity.ERROR,
    "worlds cannot be built here",
    """A simulator needs MuJoCo, which an installation without the extra `simulation` lacks:

    pip install 'robocomp_dsl[simulation]'""",
)

IMPOSSIBLE_WORLD = Code(
    "RC632",
    Severity.ERROR,
    "the world cannot be simulated",
    """The file is well formed, but MuJoCo cannot build what it describes; the message is MuJoCo's
or says which node is in the way. Usual causes are two nodes with one id and sizes or masses that
are not finite.""",
)

SIMPLIFIED_WORLD = Code(
    "RC633",
    Severity.WARNING,
    "something is simulated otherwise than described",
    """The world is built, with something simpler in the place of what was described: a mesh whose
file is missing or in a format that only OpenSceneGraph reads becomes a box, a node with
`engine="bullet"` inside another one moves with that instead of falling.""",
)

NOTHING_ASKED = Code(
    "RC635",
    Severity.WARNING,
    "what was asked for has no device in this world",
    """`rcgen simulator --also JointMotorSimple` serves joints by that interface, too, and
`--also Camera` cameras; a world without them has nothing to serve.""",
)

UNDERSTOOD_WORLD = Code(
    "RC634",
    Severity.WARNING,
    "a world with errors is simulated as far as it is understood",
    """What is wrong in a description does not keep the rest from being simulated: a second node of
the same id gets a number (`wall#2`), a value that cannot be read is the default of its attribute,
unknown tags and attributes and files that are not there are left out. Each is told at its place.

`rcgen simulator --strict` makes nothing then; `rcgen check` fails in any case.""",
)

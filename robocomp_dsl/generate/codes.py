"""Finding codes of code generation, export and simulation."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

NO_TARGET = Code(
    "RC601",
    Severity.ERROR,
    "no generator for this language",
    """The component declares `language Cpp;` or another language without a generator. Only Python
has one. Write `language Python;` in the CDSL file, or keep the file and select Python on the
command line:

    rcgen component robot.cdsl --language python

The generated component talks to components of any language through its middleware.""",
)

MISSING_METHOD = Code(
    "RC611",
    Severity.WARNING,
    "missing method: an operation or state has no method in your class",
    """The component implements or subscribes to an interface, or has a state machine, and
`specificworker.py` has no method for one of its operations or states. rcgen appends a stub to the
class, and the necessary imports to yours; it changes nothing else in the file. Put your code into
the stub:

    def Speech_say(self, req: DatasayReq) -> tuple[int, DatasayResp]:
        return 0, DatasayResp()

Until then a caller receives `RemoteError`, and messages of a topic are dropped.""",
)

STALE_METHOD = Code(
    "RC614",
    Severity.WARNING,
    "stale method: its operation or state no longer exists",
    """An operation was removed from its interface, a port from the component, or a state from the
state machine, but the method is still in `specificworker.py`. Nothing calls it. If the operation
was renamed, a stub with the new name is at the end of the class: move your code there. rcgen never
deletes your code; delete the method to remove this warning.""",
)

CHANGED_SIGNATURE = Code(
    "RC615",
    Severity.WARNING,
    "the signature of an operation has changed",
    """The operation has other inputs or results than your method. The finding shows both
signatures, the one in your file and the required one:

    old: def Speech_say(self, text: str) -> int
    new: def Speech_say(self, text: str, loud: bool) -> int

Change the method; rcgen does not edit it. Parameters with names or annotations of your own are not
reported, as long as the call works.""",
)

UNKNOWN_PARAMETER = Code(
    "RC616",
    Severity.WARNING,
    "unknown parameter",
    """`self.params.<name>` names no parameter of the PDSL file: the parameter was renamed or
removed, or its name is misspelt. The line raises `AttributeError` when it runs.""",
)

UNKNOWN_OPERATION = Code(
    "RC617",
    Severity.WARNING,
    "unknown operation",
    """`self.<port>_proxy.<operation>` names no operation of the interface: the operation was
renamed or removed in the IDSL file, or its name is misspelt. The line raises `AttributeError` when
it runs.""",
)

UNKNOWN_EVENT = Code(
    "RC624",
    Severity.WARNING,
    "unknown event or state",
    """`self.machine.send("<event>")` or `self.machine.is_in("<state>")` names no event or state of
the state machine: it was renamed or removed in the SMDSL or SCXML file, or it is misspelt. The
line raises `UnknownEvent` when it runs.""",
)

MERGED = Code(
    "RC618",
    Severity.NOTE,
    "one of your files was merged with the new output",
    """`README.md` and `etc/config.yaml` are written once; then they are yours. Both you and the
descriptions have changed the file, in different places: it now holds both changes.
`.rcgen/pristine` holds the output without your changes. Keep `.rcgen` under version control,
because the next merge starts from it.""",
)

NOT_MERGED = Code(
    "RC619",
    Severity.WARNING,
    "one of your files could not be merged with the new output",
    """You and rcgen changed the same lines of one of your files. rcgen does not change it. The
folder `.rcgen/conflicts` holds the merge result, with your lines, the previous ones and the new
ones between conflict markers: copy what you need from it.""",
)

UNREADABLE_MANIFEST = Code(
    "RC620",
    Severity.WARNING,
    "the manifest of the last generation cannot be read",
    """`.rcgen/methods.json` holds the methods and signatures of the last generation. rcgen uses it
to find stale methods and changed signatures. The file is damaged, for example by conflict markers
of a merge. rcgen writes it again from the current descriptions.""",
)

PACKAGE_RENAMED = Code(
    "RC625",
    Severity.NOTE,
    "the generated code moves to a package named after the component",
    """Earlier versions of rcgen wrote the generated code of every component to the folder
`generated/`. Two components could not be imported into one process, because both packages had that
name. Now the package is named after the component:

    from generated.interfaces import TLaserData            before
    from wander_generated.interfaces import TLaserData     now

rcgen changes only the import statements of your files, and removes the files that it wrote to
`generated/`. Update `.gitignore` and the configuration of other tools that name the folder.""",
)

OLD_PACKAGE_REFERENCED = Code(
    "RC626",
    Severity.WARNING,
    "one of your files still names the folder `generated`",
    """The generated code is now in a package named after the component. rcgen could not change this
place: a string that may be a path, an import of a module that rcgen did not write, or a file that
rcgen cannot read or write. Change it by hand.""",
)

OLD_PACKAGE_NOT_REMOVED = Code(
    "RC627",
    Severity.NOTE,
    "the folder `generated` holds files that rcgen did not write",
    """The generated code is now in a package named after the component. rcgen removes only the
files that it wrote itself from the old folder; it recognises them by their first line. The other
files are yours: move them, and change their imports.""",
)

NO_WORKER = Code(
    "RC612",
    Severity.WARNING,
    "your file has no class `SpecificWorker`",
    """`main.py` runs the class `SpecificWorker` of `specificworker.py`. The file exists, so rcgen
does not overwrite it, but it lacks the class:

    from wander_generated.genericworker import GenericWorker

    class SpecificWorker(GenericWorker):
        ...

To generate the file again, move it away and run rcgen.""",
)

UNREADABLE_WORKER = Code(
    "RC613",
    Severity.WARNING,
    "your file could not be parsed",
    """`specificworker.py` has a syntax error or is not a text file, so rcgen cannot tell which
operations it implements, and does not change it. The component does not start until you fix it.""",
)


RENAMED_IN_EXPORT = Code(
    "RC621",
    Severity.WARNING,
    "a name is spelled differently in the exported files",
    """The target format does not allow this name, or does not distinguish it from another one:
Slice and ROS 2 do not distinguish `Pose` and `pose`, and Slice reserves names that begin with
`Ice` or end in `Prx`, `Ptr`, `Helper` or `Holder`.

Fields and parameters have no names on the wire, so a new name only affects code that uses it. Ice
sends the names of modules, interfaces, operations and exceptions: a peer generated from the
exported file cannot communicate with one that uses the old name. Choose a name in the IDSL file
that is valid in all formats:

    struct IceCream { int scoops; };      wrong for Slice
    struct Gelato { int scoops; };        right""",
)

RESHAPED_IN_EXPORT = Code(
    "RC622",
    Severity.WARNING,
    "a type has another layout in the exported files",
    """The target format has no such type. Slice has no struct without fields; the export adds a
dummy field. Data encoded with one layout cannot be decoded with the other.

    struct Nothing { };                   wrong for Slice
    struct Nothing { bool unused; };      right: the same everywhere""",
)

NOT_EXPORTABLE = Code(
    "RC623",
    Severity.ERROR,
    "the format cannot express this",
    """The target format cannot represent this, and an approximation would change the meaning.
Slice has no negative values in enumerations:

    enum Level { Low = -1, High };        wrong for Slice
    enum Level { Low, High };             right""",
)

NO_SIMULATION = Code(
    "RC631",
    Severity.ERROR,
    "MuJoCo is not installed",
    """A simulator needs MuJoCo, which is installed with the extra `simulation`:

    pip install 'robocomp_dsl[simulation]'""",
)

IMPOSSIBLE_WORLD = Code(
    "RC632",
    Severity.ERROR,
    "the world cannot be simulated",
    """The syntax of the file is valid, but MuJoCo cannot build the model; the message is MuJoCo's
or names the node that causes the error. Usual causes are two nodes with the same id, and sizes or
masses that are not finite.""",
)

SIMPLIFIED_WORLD = Code(
    "RC633",
    Severity.WARNING,
    "part of the world is simplified",
    """The world is built, but a part is replaced by something simpler: a mesh that cannot be read
is a small marker that touches nothing (`.ive` and `.osgb` need the program `osgconv` of
OpenSceneGraph), a mesh in `.dae` is its bounding box; a node with `engine="bullet"` inside another
node is attached to that node instead of falling.""",
)

OPT_IN_WITHOUT_DEVICE = Code(
    "RC635",
    Severity.WARNING,
    "this world has no device for an interface of `--also`",
    """`rcgen simulator --also JointMotorSimple` also serves joints through that interface, and
`--also Camera` cameras; this world has no such device. Remove the option.""",
)

REPAIRED_WORLD = Code(
    "RC634",
    Severity.WARNING,
    "a world with errors is simulated with repairs",
    """Errors in a description do not prevent the simulation of the rest: a second node with the
same id gets a number (`wall#2`), an invalid value is replaced by the default of its attribute, and
unknown tags, unknown attributes and missing files are ignored. Each error is reported at its
place.

With `rcgen simulator --strict` nothing is generated; `rcgen check` fails in any case.""",
)

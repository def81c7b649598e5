"""RC2xx: names, imports and the files that a description mentions."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

MISSING_IMPORT = Code(
    "RC201",
    Severity.ERROR,
    "an imported file is nowhere to be found",
    """\
An interface description is looked for by its name in these folders, and the first one found is
used: the folder of the checked file, the folders given with `-I`, those listed in the environment
variable ROBOCOMP_INTERFACES (separated by `:`), and the interfaces that come with the tool. The
folders of a written path do not matter. Upper and lower case do.

Wrong:

    import "laser.idsl";

Right:

    import "Laser.idsl";
""",
)

IMPORT_CYCLE = Code(
    "RC202",
    Severity.ERROR,
    "files import each other in a circle",
    """\
A file that imports itself, directly or through others, has no beginning: neither file can be
understood before the other one.

Wrong:

    // Arm.idsl                        // Hand.idsl
    import "Hand.idsl";                import "Arm.idsl";

Right: what both need moves into a third file.

    // Arm.idsl                        // Hand.idsl
    import "ArmTypes.idsl";            import "ArmTypes.idsl";
""",
)

REPEATED_NAME = Code(
    "RC203",
    Severity.ERROR,
    "a name is given twice in one place",
    """\
Within one place every name means one thing: the declarations of a module, the fields of a struct,
the parameters of an operation, the operations of an interface (there is no overloading), the
values of an enumeration, the ports of a component, the parameters of a group, the components of a
deployment.

Wrong:

    struct Pose { float x; float x; };

Right:

    struct Pose { float x; float y; };

Ports are told apart without regard to case, because proxies are called in lower case. An interface
that is used twice needs no names of its own: the second port is called `Laser1`, the third
`Laser2`; `requires Laser as front` gives a port a name.
""",
)

UNKNOWN_INTERFACE = Code(
    "RC204",
    Severity.ERROR,
    "a component uses an interface that is not declared",
    """\
What a component implements, requires, publishes or subscribes to is declared in an IDSL file that
it imports, or that one of those imports. The name is that of the interface, which may differ from
that of the file.

Wrong:

    import "Laser.idsl";
    Component reader { Communications { requires Lasr; }; language Python; };

Right:

    import "Laser.idsl";
    Component reader { Communications { requires Laser; }; language Python; };
""",
)

AMBIGUOUS_INTERFACE = Code(
    "RC205",
    Severity.ERROR,
    "the name of an interface has several meanings",
    """\
Two imported files declare an interface of this name. Direct imports come first, and among those a
file that is called as the interface; else the module in front of the name says which is meant.

Wrong, where both files declare `Laser`:

    import "Laser.idsl";
    import "OldLaser.idsl";
    Component reader { Communications { requires Laser; }; language Python; };

Right:

    Component reader { Communications { requires RoboCompLaser::Laser; }; language Python; };
""",
)

INTERFACE_NOT_IMPORTED = Code(
    "RC206",
    Severity.ERROR,
    "a component uses an interface whose file it does not import",
    """\
The interface exists in a file that could be imported, but neither the component nor one of its
imports does. The fix adds the import.

Wrong:

    Component reader { Communications { requires Laser; }; language Python; };

Right:

    import "Laser.idsl";
    Component reader { Communications { requires Laser; }; language Python; };
""",
)

NOT_IMPORTABLE = Code(
    "RC207",
    Severity.ERROR,
    "an import does not name an interface description",
    """\
Components and interfaces import `.idsl` files, by name. They are looked for in the interface
folders only (see RC201): a path that leads elsewhere, up the tree or to another kind of file, is
not followed.

Wrong:

    import "../../etc/passwd";

Right:

    import "Laser.idsl";
""",
)

REPEATED_IMPORT = Code(
    "RC208",
    Severity.WARNING,
    "a file is imported twice",
    """\
The second import of a file does nothing.

Wrong:

    import "Laser.idsl";
    import "Laser.idsl";

Right:

    import "Laser.idsl";
""",
)

UNREADABLE_IMPORT = Code(
    "RC209",
    Severity.ERROR,
    "a file that is mentioned cannot be read",
    """\
The file is there, but it cannot be read, is too large, or is not a text in UTF-8.

Wrong, where the file was saved by a program that writes UTF-16:

    import "Laser.idsl";

Right: save it as UTF-8, and make it readable: `chmod u+r Laser.idsl`.
""",
)

IMPORTS_TOO_DEEP = Code(
    "RC210",
    Severity.ERROR,
    "imports nest too deep",
    """\
A file imports a file that imports a file, more than 50 times. That is most likely the work of a
program that went wrong; what people write nests three or four times.

Wrong: `A1.idsl` imports `A2.idsl`, which imports `A3.idsl`, and so on to `A60.idsl`.

Right: one file declares what the others need, and they import that one.
""",
)

MISSING_FILE = Code(
    "RC211",
    Severity.ERROR,
    "a file that is mentioned is nowhere to be found",
    """\
The path of a parameter file, of a component or of a configuration is relative to the folder of the
file that it is written in, wherever the tool is started.

Wrong, in components/arm/arm.cdsl, where arm.pdsl stands beside it:

    parameters "components/arm/arm.pdsl";

Right:

    parameters "arm.pdsl";
""",
)

WRONG_SUFFIX = Code(
    "RC212",
    Severity.ERROR,
    "a file of another kind is expected here",
    """\
What a file is can be told from the end of its name: `.cdsl` a component, `.idsl` interfaces,
`.pdsl` parameters, `.ddsl` a deployment, `.yaml`, `.yml` or `.toml` a configuration.

Wrong:

    parameters "config.yaml";

Right:

    parameters "arm.pdsl";
""",
)

NOT_AN_INTERFACE = Code(
    "RC213",
    Severity.ERROR,
    "a component uses something that is not an interface",
    """\
Only an interface can be implemented, required, published or subscribed to; a type or an exception
is carried by its operations.

Wrong, where `TLaserData` is a sequence:

    Component reader { Communications { subscribesTo TLaserData; }; language Python; };

Right:

    Component reader { Communications { subscribesTo LaserPub; }; language Python; };
""",
)

UNKNOWN_MIDDLEWARE = Code(
    "RC214",
    Severity.ERROR,
    "there is no such middleware",
    """\
A middleware is one that comes with the tool, `zenoh` or `inproc` (all in one process, for tests),
or one that was installed beside it.

Wrong:

    middleware zeno;

Right:

    middleware zenoh;
""",
)

NO_BRIDGE = Code(
    "RC215",
    Severity.WARNING,
    "a port asks for a middleware that is not there yet",
    """\
`(ice)` or `(ros)` behind an interface asks for this port to speak that middleware. Until the bridge
to it exists the port uses the middleware of its component, as all others do, and talks to
components that do so too.

    requires Laser(ros);      // for now as good as:
    requires Laser;
""",
)

OPTION_WITHOUT_EFFECT = Code(
    "RC216",
    Severity.WARNING,
    "nothing is generated for an option",
    """\
The older tool added code of a library to a component with this option (`dsr`, `InnerModelViewer`).
The component is generated without it.

Without effect:

    options dsr;

Better: leave it out, and import the library in the code that uses it.
""",
)

NO_GUI = Code(
    "RC217",
    Severity.WARNING,
    "no code is generated for a user interface",
    """\
The older tool opened a Qt window of the named kind in every component with a `gui`. The component
is generated without it; its parameters and its state can be watched and changed from outside.

Without effect:

    gui Qt(QWidget);

Better: leave it out, and open a window in the code of the component where it needs one.
""",
)

NO_STATE_MACHINE = Code(
    "RC218",
    Severity.WARNING,
    "a state machine is not there",
    """\
`statemachine` names a file beside the CDSL file. The component is generated without it.

Wrong, where the file is called `statemachine.smdsl`:

    statemachine "machine.smdsl";

Right:

    statemachine "statemachine.smdsl";
""",
)

COMPONENT_NUMBER = Code(
    "RC219",
    Severity.ERROR,
    "a number of a component is out of range",
    """\
`period` is the time between two calls of `compute`, in whole milliseconds up to a day; 0 means that
it is never called. `threads` is how many handlers may run at a time, from 1 (one after the other,
so that the code needs no locks) to 1024.

Wrong:

    period 0.5;
    threads 0;

Right:

    period 1;
    threads 1;
""",
)

UNKNOWN_SUFFIX = Code(
    "RC220",
    Severity.ERROR,
    "the language of a file cannot be told",
    """\
The end of a file's name says in which language it is written: `.idsl` interfaces, `.cdsl` a
component, `.pdsl` parameters, `.ddsl` a deployment, `.smdsl` and `.scxml` states, `.xml` a body,
`.yaml` generic parts and skin.

Wrong:

    rcgen check robot.txt

Right:

    rcgen check robot.cdsl
""",
)

SLICE_IMPORT = Code(
    "RC221",
    Severity.WARNING,
    "an import names the Ice form of an interface",
    """\
RoboComp's older tools write a `.ice` file from each interface description, and some descriptions
import it. The `.idsl` file of the same name says the same, and is taken in its place.

Wrong:

    import "Laser.ice";

Right:

    import "Laser.idsl";
""",
)

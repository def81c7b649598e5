"""RC2xx: names, imports and referenced files."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

MISSING_IMPORT = Code(
    "RC201",
    Severity.ERROR,
    "imported file not found",
    """\
The first file found is used: the path as written, relative to the importing file; then its last
part beside the checked file and beside the importing file; then both in the `-I` folders, in the
folders of the environment variable ROBOCOMP_INTERFACES (separated by `:`), in `interfaces/` and
`interfaces/IDSLs/` beside or above the file; then the interfaces that come with the tool. File
names are case-sensitive.

Wrong:

    import "laser.idsl";

Right:

    import "Laser.idsl";
""",
)

MISSING_ROS_DEFINITION = Code(
    "RC222",
    Severity.ERROR,
    "ROS definition not found",
    """\
The path of an imported ROS definition has its package: `package/msg/Name.msg`,
`package/srv/Name.srv` or `package/action/Name.action`. The first match is used, in the folder of
the checked file, the `-I` folders, those of ROBOCOMP_INTERFACES, AMENT_PREFIX_PATH (ROS 2) and
ROS_PACKAGE_PATH (ROS 1), the interfaces that come with the tool, and the library rosbags, which has
the common messages of ROS 2: `pip install robocomp_dsl[ros]`. A folder contains packages, or
`share` with packages.

Wrong:

    import "LaserScan.msg";

Right:

    import "sensor_msgs/msg/LaserScan.msg";
""",
)

IMPORT_CYCLE = Code(
    "RC202",
    Severity.ERROR,
    "import cycle",
    """\
A file must not import itself, directly or through other files: neither file can be resolved before
the other one.

Wrong:

    // Arm.idsl                        // Hand.idsl
    import "Hand.idsl";                import "Arm.idsl";

Right: move the common declarations to a third file.

    // Arm.idsl                        // Hand.idsl
    import "ArmTypes.idsl";            import "ArmTypes.idsl";
""",
)

DUPLICATE_NAME = Code(
    "RC203",
    Severity.ERROR,
    "duplicate name",
    """\
Names are unique within their scope: the declarations of a module, the fields of a struct, the
parameters of an operation, the operations of an interface (there is no overloading), the values of
an enumeration, the ports of a component, the parameters of a group, the components of a deployment.

Wrong:

    struct Pose { float x; float x; };

Right:

    struct Pose { float x; float y; };

Port names are compared without case, because proxies have lower-case names. If an interface is used
twice, the second port is called `Laser1` and the third `Laser2`; `requires Laser as front` gives a
port another name.
""",
)

UNKNOWN_INTERFACE = Code(
    "RC204",
    Severity.ERROR,
    "unknown interface",
    """\
A component implements, requires, publishes or subscribes to interfaces that an imported IDSL file
declares, directly or through its own imports. Write the name of the interface, which may differ
from the name of the file.

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
    "ambiguous interface name",
    """\
Two imported files declare an interface with this name. Direct imports take precedence, and among
them a file with the name of the interface. Otherwise write the module before the name.

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
    "interface not imported",
    """\
A file in the interface folders declares this interface, but the component does not import it,
directly or indirectly. The fix adds the import.

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
    "an import must name an `.idsl` file",
    """\
Components and interfaces import `.idsl` files by name or path; RC201 tells where they are searched.

Wrong:

    import "../../etc/passwd";

Right:

    import "Laser.idsl";
""",
)

DUPLICATE_IMPORT = Code(
    "RC208",
    Severity.WARNING,
    "duplicate import",
    """\
The second import of a file has no effect.

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
    "a referenced file cannot be read",
    """\
The file exists, but it cannot be read, is too large, or is not encoded in UTF-8.

Wrong, where the file was saved by a program that writes UTF-16:

    import "Laser.idsl";

Right: save it as UTF-8, and make it readable: `chmod u+r Laser.idsl`.
""",
)

IMPORTS_TOO_DEEP = Code(
    "RC210",
    Severity.ERROR,
    "imports are nested too deeply",
    """\
Imports may be nested 50 deep. A deeper chain is probably generated by a faulty program;
hand-written files nest three or four deep.

Wrong: `A1.idsl` imports `A2.idsl`, which imports `A3.idsl`, and so on to `A60.idsl`.

Right: one file declares what the others need, and they import that one.
""",
)

MISSING_FILE = Code(
    "RC211",
    Severity.ERROR,
    "referenced file not found",
    """\
The path of a parameter file, a component or a configuration is relative to the folder of the file
that contains it, not to the working directory.

Wrong, in components/arm/arm.cdsl, with arm.pdsl in the same folder:

    parameters "components/arm/arm.pdsl";

Right:

    parameters "arm.pdsl";
""",
)

WRONG_SUFFIX = Code(
    "RC212",
    Severity.ERROR,
    "wrong file suffix",
    """\
The suffix names the kind of a file: `.cdsl` a component, `.idsl` interfaces, `.pdsl` parameters,
`.ddsl` a deployment, `.yaml`, `.yml` or `.toml` a configuration. RoboComp's `etc/config` has none.

Wrong:

    parameters "config.yaml";

Right:

    parameters "arm.pdsl";
""",
)

NOT_AN_INTERFACE = Code(
    "RC213",
    Severity.ERROR,
    "not an interface",
    """\
Only an interface can be implemented, required, published or subscribed to; types and exceptions are
used by its operations.

Wrong, where `TLaserData` is a sequence:

    Component reader { Communications { subscribesTo TLaserData; }; language Python; };

Right:

    Component reader { Communications { subscribesTo LaserPub; }; language Python; };
""",
)

UNKNOWN_MIDDLEWARE = Code(
    "RC214",
    Severity.ERROR,
    "unknown middleware",
    """\
`zenoh` is the default, and `inproc` connects the components of one process. The finding
lists the others: those that the tool includes, and those of installed packages.

Wrong:

    middleware zeno;

Right:

    middleware zenoh;
""",
)

NO_BRIDGE = Code(
    "RC215",
    Severity.WARNING,
    "middleware of a port not available",
    """\
`(ros)` after an interface is accepted in files of older tools. The middlewares are called `ros1`
and `ros2` here, so the port uses that of its component. The same holds for a middleware that is not
installed.

Wrong:

    requires Laser(ros);

Right:

    requires Laser(ros1);
""",
)

OPTION_WITHOUT_EFFECT = Code(
    "RC216",
    Severity.WARNING,
    "option without effect",
    """\
The older tool added library code to a component with this option (`dsr`, `InnerModelViewer`). This
tool generates the component without it.

Without effect:

    options dsr;

Better: delete it, and import the library in your own code.
""",
)

FORM_MISMATCH = Code(
    "RC411",
    Severity.WARNING,
    "the form does not fit the window",
    """\
`gui` names the class of the window, and `mainUI.ui` contains its widgets. The form of a
`QMainWindow` has a central widget and menus, which other windows lack; a layout of another form has
no place in a `QMainWindow`. So both must be for the same class; a `QDialog` also takes the form of
a `QWidget`.

Wrong, where `mainUI.ui` begins with `<widget class="QMainWindow" …>`:

    gui Qt(QWidget);

Right:

    gui Qt(QMainWindow);
""",
)

NO_STATE_MACHINE = Code(
    "RC218",
    Severity.WARNING,
    "state machine file not found",
    """\
`statemachine` names a file relative to the CDSL file. The component is generated without it.

Wrong, where the file is called `statemachine.smdsl`:

    statemachine "machine.smdsl";

Right:

    statemachine "statemachine.smdsl";
""",
)

COMPONENT_NUMBER = Code(
    "RC219",
    Severity.ERROR,
    "`period`, `threads` or `watchdog` is out of range",
    """\
`period` is the time between two calls of `compute`, in whole milliseconds up to a day; with 0
`compute` is not called. `threads` is the number of handlers that may run concurrently, from 1 (no
concurrency, so the code needs no locks) to 1024. `watchdog` is the time after which a callback that
has not returned hangs, from 100 ms to a day; `0 s` is no watchdog.

Wrong:

    period 0.5;
    threads 0;
    watchdog 1 ms;

Right:

    period 1;
    threads 1;
    watchdog 2 s;
""",
)

UNKNOWN_SUFFIX = Code(
    "RC220",
    Severity.ERROR,
    "unknown file suffix",
    """\
The suffix names the language of a file: `.idsl` interfaces, `.cdsl` a component, `.pdsl`
parameters, `.ddsl` a deployment, `.smdsl` and `.scxml` state machines, `.xml` an InnerModel world,
`.yaml` a tactile description.

Wrong:

    rcgen check robot.txt

Right:

    rcgen check robot.cdsl
""",
)

OTHER_SUFFIX = Code(
    "RC221",
    Severity.WARNING,
    "import of an `.ice` file, or without a suffix",
    """\
RoboComp's older tools generate an `.ice` file from each interface description, and some
descriptions import it; others import without a suffix. The `.idsl` file with the same name is used.

Wrong:

    import "Laser.ice";
    import "Camera";

Right:

    import "Laser.idsl";
    import "Camera.idsl";
""",
)

"""The findings of a migration of YARP's files; severities are those of `migrate.codes`."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNKNOWN_ELEMENT = Code(
    "RC976",
    Severity.WARNING,
    "an element or attribute that YARP does not know",
    """YARP ignores it with a warning, and so does the migration. Usually it is misspelled, or
belongs to another version of YARP. If the robot needs what it says, write that into the DDSL
file.""",
)

INCOMPLETE_ELEMENT = Code(
    "RC977",
    Severity.ERROR,
    "an element of a YARP file is invalid",
    """A module without a name, a connection without an end, a device without a type: YARP
rejects it, so it is not in the deployment. Complete it and run `rcgen migrate` again, or add the
line to the DDSL file.""",
)

REMOTE_NODE = Code(
    "RC978",
    Severity.WARNING,
    "modules run on another machine",
    """yarpmanager starts them through `yarprun --server`; `rcdeploy` starts them through ssh and
systemd: the host needs an ssh server that accepts your key, and a user manager. Show its key with
`rcdeploy hosts trust`, make the keys of the deployment with `rcdeploy keys`. To run a program here,
delete `on …`. A list of machines (`<cluster>`, `<resources>`) gives addresses and users; name it
beside the application.""",
)

SETTING_DROPPED = Code(
    "RC979",
    Severity.WARNING,
    "a setting of YARP was not migrated",
    """DDSL has nothing that does the same. The message says what to use instead.""",
)

SETTING_NOT_NEEDED = Code(
    "RC981",
    Severity.NOTE,
    "a setting of YARP is no longer needed",
    """`stdio` names the machine that shows the output: `rcdeploy logs` shows the output of all
programs. `rank` weighs a module for load balancing; `place by load` weighs all alike. `persist`:
`rcdeploy` keeps every connection.
`dependencies` of an application: a connection is made as soon as both ports exist.""",
)

ARBITRATOR = Code(
    "RC982",
    Severity.ERROR,
    "an arbitrator is not migrated",
    """Its rules choose between connections of programs that are no components. `arbitrate` of
DDSL chooses between connections of a component. Let a component subscribe to the ports
(`port X over yarp at "/port:o";`) and publish what its `arbitrate` delivers; or write the rules as
constraints of port monitors, in `carrier`, as YARP does.""",
)

NESTED_APPLICATION = Code(
    "RC983",
    Severity.ERROR,
    "a nested application was not found",
    """`<application><name>X</name></application>` names another file of yarpmanager. Its `<name>`
is searched in the files of the command line and in the folder of the file. Name it, too:

    rcgen migrate demo.xml cameras.xml -o demo""",
)

UNKNOWN_DEVICE_TYPE = Code(
    "RC984",
    Severity.ERROR,
    "a device of YARP has no counterpart",
    """There is no simulated device of this type; its line in the DDSL file is a comment. Write a
component that serves it (`rcgen hardware`), or run the driver in `yarprobotinterface` and connect
its ports with `connect yarp …`.""",
)

DEVICE_REPLACED = Code(
    "RC985",
    Severity.NOTE,
    "a device of YARP became a port",
    """Wrappers, remappers and network servers make other devices available on ports. The
simulator has a port for each control board and sensor, so it needs no such devices; their attach
and detach actions have no counterpart either.""",
)

INCLUDE = Code(
    "RC986",
    Severity.ERROR,
    "an included file was not read",
    """The path is relative to the including file. Copy the file there, or correct the path, and
run `rcgen migrate` again; what the file describes is missing. Files of the older format 1.0 are
included with `file="…"`, newer ones with `xi:include`; both are read.""",
)

ASSUMED_VALUE = Code(
    "RC987",
    Severity.WARNING,
    "a value that the files do not state was assumed",
    """The driver that knows the joints, their limits or their speeds is not in these files, such
as the drivers that Gazebo loads, or its file states them in another form. The generated world has
default values. Correct them in the world, or simulate the robot's real model (URDF, MJCF) with
`rcgen simulator`, with the same names of boards.""",
)

ACTION_DROPPED = Code(
    "RC988",
    Severity.WARNING,
    "an action of a device was not migrated",
    """It has no effect in YARP (`configure`, `custom`, actions of the phase `run`), or it concerns
a device that is not in the deployment.""",
)

SHARED_JOINTS = Code(
    "RC989",
    Severity.WARNING,
    "a group of joints is left out",
    """A joint belongs to one control board of the simulator. The joints of this wrapper belong to
the boards that the message names; use those.""",
)

UNSUPPORTED_FORMAT = Code(
    "RC991",
    Severity.ERROR,
    "a file of YARP is of a kind that is not migrated",
    """Migrated are applications of yarpmanager (root `<application>`) and descriptions of
yarprobotinterface (root `<robot>`, `<devices>`, `<device>`); lists of machines (`<cluster>`,
`<resources>`) together with an application. Descriptions of modules and templates have no
counterpart: name the application instead.""",
)

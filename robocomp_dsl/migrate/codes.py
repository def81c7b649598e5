"""The findings of a migration.

An error: something of the user's is missing in the new component. A warning: something may behave
differently. A note: no action is needed.
"""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNREADABLE_FILE = Code(
    "RC921",
    Severity.ERROR,
    "a file of the old component could not be read",
    """The file is binary, too large, or not in the format that its name says. Everything else was
migrated. Fix the file in the old folder, remove the new folder and run `rcgen migrate` again.""",
)

NO_DESCRIPTION = Code(
    "RC922",
    Severity.ERROR,
    "the folder has no CDSL file, or several",
    """A component is described by its CDSL file. The folder must directly contain exactly one:

    rcgen migrate robot/            # robot/robot.cdsl

For components that are older than CDSL, start with `rcgen new`.""",
)

BROKEN_DESCRIPTION = Code(
    "RC923",
    Severity.ERROR,
    "the description has errors, so no code was generated",
    """The CDSL file, or an interface that it imports, has errors; they are listed with this
one. The description, the parameters, the configurations and your code were written, but no code
was generated. Fix the errors in the old folder (`-I` adds folders with interfaces), remove the
new folder and run `rcgen migrate` again.""",
)

ALREADY_MIGRATED = Code(
    "RC924",
    Severity.ERROR,
    "the component is already migrated",
    """Its CDSL file names a PDSL file, which RoboComp's CDSL does not have. Update such a
component with `rcgen component`; there is nothing to migrate.""",
)

INVALID_CONFIG_LINE = Code(
    "RC931",
    Severity.WARNING,
    "a configuration line has no effect",
    """In the old text format each line is `key = value`. Ice ignores lines without `=`, so this
line had no effect; it is not in the new configuration.""",
)

DUPLICATE_KEY = Code(
    "RC932",
    Severity.WARNING,
    "a configuration sets a key twice",
    """The last value was in effect, so it was migrated. Check that it is the intended one.""",
)

CONFLICTING_KEY = Code(
    "RC933",
    Severity.ERROR,
    "two configurations use a key in different forms",
    """A key is a group in one place and a value or a list in another. The first form became the
parameter; the other value was left out of the new configuration. Rename one of the keys.""",
)

RENAMED_KEY = Code(
    "RC934",
    Severity.WARNING,
    "a parameter was renamed",
    """The old key is not a valid PDSL name (a letter or `_`, then letters, digits and `_`), or
two keys would get the same name. Code that reads `self.params` uses the new name; `setParams` of
migrated code still receives the old key.""",
)

LIST_IN_STRING = Code(
    "RC935",
    Severity.NOTE,
    "a list in a string stays a string",
    """The value looks like a list, `1,2,3`, which the old code splits itself; so it became a
string. For a typed list, write a list in the PDSL and the YAML:

    joints[] float;          joints: [1, 2]""",
)

MISSING_KEY = Code(
    "RC936",
    Severity.WARNING,
    "a configuration lacks a key that another one has",
    """All configurations of a component now have the same parameters. A key that a file lacks
has the default, which is the value of the first file that sets it. Check that this is right for
this configuration.""",
)

CONVERTED_TO_STRING = Code(
    "RC937",
    Severity.WARNING,
    "a value became a string",
    """PDSL has no type for it (lists of lists, dates, lists of mixed types), or the
configurations have values of different types. It is written as JSON, or unchanged.""",
)

NOT_UTF8 = Code(
    "RC938",
    Severity.WARNING,
    "a configuration is not UTF-8",
    """The file was read as Latin-1, the encoding of many old western European files. The new
files are UTF-8. Check the letters with accents.""",
)

CAPITALISED_BOOL = Code(
    "RC939",
    Severity.WARNING,
    "a boolean is not valid TOML",
    """TOML writes `true` and `false` in lower case. The value was read as if it did.""",
)

ICE_SETTING = Code(
    "RC941",
    Severity.NOTE,
    "an Ice setting is no longer needed",
    """`Ice.*` and the endpoint of IceStorm's topic manager configured a middleware that the new
component does not use: components discover each other by name, and topics need no broker.""",
)

ENDPOINT_MIGRATED = Code(
    "RC942",
    Severity.NOTE,
    "an endpoint or a proxy became part of the deployment",
    """`X.Endpoints` became a `port` of the component, `XProxy` a `connect` line in the DDSL
file.""",
)

STAND_IN = Code(
    "RC943",
    Severity.WARNING,
    "another component is known only by its address",
    """The configuration names a component by host and port, and its description was not given.
A CDSL file in `peers/` is a stand-in, so that the deployment can be checked. Before you start the
deployment, import the real component instead; or migrate all folders in one run:

    rcgen migrate manager.xml laser/ base/ follow/ -o robot""",
)

UNKNOWN_PROXY = Code(
    "RC944",
    Severity.WARNING,
    "an address belongs to no port of the component",
    """The configuration has an endpoint or a proxy for an interface that the CDSL file does not
mention, so there is nothing to connect. In the old component it only had an effect if
hand-written code used it.""",
)

NOT_PYTHON = Code(
    "RC951",
    Severity.ERROR,
    "C++ code is not migrated",
    """Code is generated for Python only. The descriptions, parameters and configurations are
complete; rewrite the C++ algorithm in `specificworker.py`, or call it from there as a library
(pybind11, ctypes). The new component can communicate with old ones only through a bridge.""",
)

UNREADABLE_PYTHON = Code(
    "RC952",
    Severity.ERROR,
    "Python cannot parse the old worker",
    """It is neither Python 3 nor Python 2, or `fissix`, which converts Python 2, is not installed
(`pip install 'robocomp_dsl[migrate]'`). The file was copied next to the new, empty
`specificworker.py` with the suffix `.old`. Fix the line in the old folder, remove the new folder
and run `rcgen migrate` again.""",
)

NO_WORKER = Code(
    "RC953",
    Severity.ERROR,
    "there is no class SpecificWorker to migrate",
    """`src/specificworker.py` is missing or has no such class; the new class has empty methods.""",
)

IMPORT_ADAPTED = Code(
    "RC954",
    Severity.NOTE,
    "an import of the old worker was adapted",
    """RoboComp's generated modules, `Ice` and parts of Qt are replaced by one module in the new
folder, which provides the names that the methods use. The methods themselves are unchanged, byte
by byte.""",
)

NEEDS_QT_OR_ICE = Code(
    "RC955",
    Severity.ERROR,
    "the worker uses Qt or Ice itself",
    """`legacy.py` has timers, signals, locks and the application of Qt, and the exceptions of Ice;
the code uses more. Proxies that it creates with `Ice.initialize` reach only old components. The
import is unchanged, so the component starts only if Qt or Ice is installed. A component with a
window needs `gui Qt(QWidget);` in its CDSL file. Use the proxies of `self`.""",
)

NAME_TAKEN = Code(
    "RC956",
    Severity.WARNING,
    "the worker sets an attribute that the component needs",
    """Every component has `params`, `log`, `name`, `clock` and other attributes. A worker that
assigns one of them hides it from the base class. Rename the attribute in your class.""",
)

PERIOD_MIGRATED = Code(
    "RC957",
    Severity.NOTE,
    "the period was moved to the description",
    """`self.Period = 50` or `Period.Compute = 50` became `period 50;` in the CDSL file.
`self.timer.start(self.Period)` of the worker sets it, too.""",
)

UNKNOWN_STATE_METHOD = Code(
    "RC958",
    Severity.ERROR,
    "a state method has no state",
    """RoboComp called `sm_search` on entry to the state `search`. The component's state machine
has no state of that name, so the method is never called. Rename or delete the method.""",
)

LEGACY_STATE_METHOD = Code(
    "RC959",
    Severity.NOTE,
    "a state method is called by `legacy.py`",
    """RoboComp called `sm_search` on entry to the state `search`, and code sent an event with
`self.t_search_to_found.emit()`. `legacy.py` still does both. To remove it, rename the
method to `on_enter_search` and send the event yourself:

    self.machine.send("t_search_to_found")""",
)

NOT_COPIED = Code(
    "RC961",
    Severity.ERROR,
    "a file was not copied",
    """It is too large, unreadable, a link, or its name is taken in the new component. Copy it by
hand if the component needs it.""",
)

GENERATED_FILE_DROPPED = Code(
    "RC962",
    Severity.NOTE,
    "a file that RoboComp generated has no replacement",
    """Build files and generated code are not needed: `rcgen component` writes generated code.""",
)

QT_WINDOW = Code(
    "RC963",
    Severity.ERROR,
    "a Qt window is not migrated",
    """A `.ui` file describes a Qt window; generated components have none. Show and change
parameters and states with `rcdeploy`, or write a separate program for the window that
communicates with the component.""",
)

NODE_DROPPED = Code(
    "RC971",
    Severity.NOTE,
    "a process of the old manager is no longer needed",
    """`rcnode` and `icebox` ran IceStorm's broker for topics. Topics now go directly from
publisher to subscriber.""",
)

NODE_INCOMPLETE = Code(
    "RC972",
    Severity.ERROR,
    "an entry of the old manager is invalid",
    """It has no name, or its name is already used; so it is not in the deployment. Fix the entry
and run `rcgen migrate` again, or add the component to the DDSL file.""",
)

DEPENDENCE_DROPPED = Code(
    "RC973",
    Severity.WARNING,
    "a dependency was left out",
    """It names an entry that does not exist, or it would close a cycle. The old manager started
such components in an arbitrary order.""",
)

UNUSED_COMMAND = Code(
    "RC974",
    Severity.NOTE,
    "a command of the old manager is not used",
    """The deployment starts each component with `python3 main.py` in its folder. The old command
is a comment in the DDSL file; `executable "…";` sets another command.""",
)

MANAGER_SETTING = Code(
    "RC975",
    Severity.WARNING,
    "a setting of the manager was not migrated",
    """The entry names a configuration that the component does not have, or an address that is
not valid in a deployment.""",
)

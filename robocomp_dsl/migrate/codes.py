"""The findings of this stage: what was not carried over, and what to look at.

An error is something of the user's that the new component lacks; a warning is something that
may behave otherwise; a note is something that needs nothing.
"""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

UNREADABLE_FILE = Code(
    "RC921",
    Severity.ERROR,
    "a file of the old component could not be read",
    """The file is no text, too large, or not in the form that its name promises (a
configuration in TOML with a mistake, a manager file that is no XML). Everything else was
carried over. Mend the file in the old folder, remove the new folder and run `rcgen migrate`
again.""",
)

NO_DESCRIPTION = Code(
    "RC922",
    Severity.ERROR,
    "there is no CDSL file to begin with, or there are several",
    """A component is what its CDSL file says. The folder must hold exactly one, directly in it:

    rcgen migrate robot/            # robot/robot.cdsl

Components that were written before there was CDSL can be begun with `rcgen new`.""",
)

BROKEN_DESCRIPTION = Code(
    "RC923",
    Severity.ERROR,
    "the description has errors, so no code was generated",
    """The CDSL file, or an interface that it imports, has errors; they are listed beside this
one. The description, the parameters, the configurations and your code were written all the
same; nothing was generated. Mend the errors in the old folder (`-I` adds folders with
interfaces that are missing), remove the new folder and run `rcgen migrate` again.""",
)

ALREADY_OURS = Code(
    "RC924",
    Severity.ERROR,
    "the component has moved over already",
    """Its CDSL file names a PDSL file, as RoboComp's do not. Such a component is kept up to date
with `rcgen component`; there is nothing to migrate.""",
)

CONFIG_LINE = Code(
    "RC931",
    Severity.WARNING,
    "a line of a configuration says nothing",
    """In the old text form each line is `key = value`. Ice leaves out lines without `=`, so
this one had no effect; it has none in the new configuration either.""",
)

CONFIG_TWICE = Code(
    "RC932",
    Severity.WARNING,
    "a configuration gives a key twice",
    """The last value is the one that counted, so it is the one that was carried over. Is it the
one that was meant?""",
)

CONFIG_CLASH = Code(
    "RC933",
    Severity.ERROR,
    "two configurations give a key in forms that do not fit together",
    """A key is a group in one place and a value or a list in another: the first form became the
parameter, the other value is not in the new configuration of its file. Give one of them another
name.""",
)

RENAMED_KEY = Code(
    "RC934",
    Severity.WARNING,
    "a parameter is called otherwise",
    """The old key is no name of PDSL (a letter or `_`, then letters, digits and `_`), or two
keys would have the same. Code that reads `self.params` uses the new name; `setParams` of
carried over code still gets the old key.""",
)

TEXT_LIST = Code(
    "RC935",
    Severity.NOTE,
    "a list in a text stays a text",
    """The value looks like a list, `1,2,3`, which the old code splits itself; so it became a
string. For a typed list write a list of groups into the PDSL and the YAML:

    joints[] { value float; };          joints: [{value: 1}, {value: 2}]""",
)

MISSING_KEY = Code(
    "RC936",
    Severity.WARNING,
    "a configuration lacks a key that another one has",
    """All configurations of a component have the same parameters now. Where a file does not
give one, it has the default, which is the value of the first file that gives it. Is that right
for this configuration?""",
)

NOT_SUPPORTED_VALUE = Code(
    "RC937",
    Severity.WARNING,
    "a value became a text",
    """There is no type for it in PDSL (lists of lists, dates, lists of different things), or
the configurations give values of different kinds. It is written as JSON or as it stood.""",
)

NOT_UTF8 = Code(
    "RC938",
    Severity.WARNING,
    "a configuration is in an old encoding",
    """The file is not UTF-8, so it was read as Latin-1, which old Spanish and other western
files are in. The new files are UTF-8. Look at the letters with accents.""",
)

CAPITAL = Code(
    "RC939",
    Severity.WARNING,
    "a truth value is not written as TOML has it",
    """TOML has `true` and `false`, in small letters. The file is read as if it said so.""",
)

ICE_SETTING = Code(
    "RC941",
    Severity.NOTE,
    "a setting of Ice is not needed any more",
    """`Ice.*` and the endpoint of IceStorm's topic manager tuned a middleware that the new
component does not use: components find each other by name, and topics need no broker.""",
)

WIRED = Code(
    "RC942",
    Severity.NOTE,
    "an endpoint or a proxy became part of the deployment",
    """`X.Endpoints` is a `port` of the component, `XProxy` a `connect` line in the DDSL file.""",
)

STAND_IN = Code(
    "RC943",
    Severity.WARNING,
    "another component is only known by its address",
    """The configuration names a component by host and port, and its description is not here. A
CDSL file in `peers/` stands for it, so that the deployment can be checked. Put the import of
the real component in its place before you start the deployment; or hand all folders to one run:

    rcgen migrate manager.xml laser/ base/ follow/ -o robot""",
)

UNKNOWN_PROXY = Code(
    "RC944",
    Severity.WARNING,
    "an address belongs to no port of the component",
    """The configuration has an endpoint or a proxy for an interface that the CDSL file does not
mention, so there is nothing to connect. It had no effect before either, unless hand-written
code used it.""",
)

NOT_PYTHON = Code(
    "RC951",
    Severity.ERROR,
    "code in C++ is not carried over",
    """There is a generator for Python only. The descriptions, parameters and configurations are
complete; the algorithm in C++ has to be written anew in `specificworker.py`, or be called from
there as a library (pybind11, ctypes). The new component can talk to the old ones meanwhile only
through a bridge.""",
)

UNREADABLE_PYTHON = Code(
    "RC952",
    Severity.ERROR,
    "Python cannot read the old worker",
    """Most often it is Python 2 (`print x`). It was copied beside the new, empty
`specificworker.py` with the ending `.old`. Bring it to Python 3 (`2to3` is a start), then run
`rcgen migrate` again, or move the methods over by hand.""",
)

NO_WORKER = Code(
    "RC953",
    Severity.WARNING,
    "there is no class SpecificWorker to carry over",
    """`src/specificworker.py` is missing or has no such class; the new one has empty methods.""",
)

CARRIED_OVER = Code(
    "RC954",
    Severity.NOTE,
    "an import of the old worker was adapted",
    """Modules that RoboComp generated or brought along (`genericworker`, `interfaces`, `Ice`,
parts of Qt) are replaced by one module in the new folder, which gives the names that the
methods use. The methods themselves are as they were, byte by byte.""",
)

NEEDS_QT = Code(
    "RC955",
    Severity.ERROR,
    "the worker uses Qt or Ice itself",
    """Windows and timers of Qt need Qt's event loop, which the new component does not run:
`compute` is called by the life cycle. Proxies that code makes with `Ice.initialize` reach only
components of old. Such an import was left as it is, so the component starts only where Qt or
Ice are installed. Move the window into a program of its own that talks to the component; write
calls that are due every so often into `compute`; take proxies from `self`.""",
)

NAME_TAKEN = Code(
    "RC956",
    Severity.WARNING,
    "the worker sets an attribute that the component needs",
    """Every component has `params`, `log`, `name`, `clock` and others. A worker that assigns
one of them hides it from the new base class. Rename the attribute in your class.""",
)

PERIOD = Code(
    "RC957",
    Severity.NOTE,
    "the period stands in the description",
    """`self.Period = 50` or `Period.Compute = 50` became `period 50;` in the CDSL file.
`compute` is called with it; `self.timer` is a stand-in that starts nothing.""",
)

STATE_METHOD = Code(
    "RC958",
    Severity.ERROR,
    "a method of a state has no state",
    """RoboComp called `sm_search` when the state `search` was entered. The machine of the component
has no state of that name, so the method is never called.""",
)

STATE_CALLED = Code(
    "RC959",
    Severity.NOTE,
    "a method of a state is called by `legacy.py`",
    """RoboComp called `sm_search` when the state `search` was entered, and code fired
`self.t_search_to_found.emit()`. `legacy.py` still does both; an event is fired in the next period.
To leave it behind, call the method `on_enter_search`, and fire the event yourself:

    self.machine.go("t_search_to_found")""",
)

NOT_COPIED = Code(
    "RC961",
    Severity.ERROR,
    "a file was not copied",
    """It is too large, cannot be read, is a link, or there is no place for it. Copy it by hand
if the component needs it.""",
)

REPLACED = Code(
    "RC962",
    Severity.NOTE,
    "a file that RoboComp generated has no successor",
    """Build files and generated code are not needed any more: `rcgen component` writes
`main.py` and `generated/`.""",
)

INTERFACE_WINDOW = Code(
    "RC963",
    Severity.ERROR,
    "a window is not carried over",
    """A `.ui` file describes a window of Qt; generated components have none. Parameters and
states can be seen and changed with `rcdeploy`; a window of your own is a program that talks to
the component.""",
)

NODE_DROPPED = Code(
    "RC971",
    Severity.NOTE,
    "a process of the old manager is not needed any more",
    """`rcnode` and `icebox` ran IceStorm's broker for topics. Topics go directly from publisher
to subscriber now.""",
)

NODE_INCOMPLETE = Code(
    "RC972",
    Severity.ERROR,
    "an entry of the old manager could not be understood",
    """It has no name, or the name is taken; so it is not in the deployment.""",
)

DEPENDENCE_DROPPED = Code(
    "RC973",
    Severity.WARNING,
    "a dependence was left out",
    """It names an entry that does not exist, or it would close a circle, in which everybody
waits for everybody. The old manager started such components in some order all the same.""",
)

COMMAND = Code(
    "RC974",
    Severity.NOTE,
    "a command of the old manager is not used",
    """The deployment starts components itself, `python3 main.py` in their folders. The old
command stands as a comment in the DDSL file; `executable "…";` sets another one.""",
)

MANAGER_SETTING = Code(
    "RC975",
    Severity.WARNING,
    "a part of the manager's file was not carried over",
    """The configuration it names is not one of the component's, or the address is not one that
a deployment can have.""",
)

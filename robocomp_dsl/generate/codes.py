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

NO_STATE_MACHINE = Code(
    "RC602",
    Severity.WARNING,
    "nothing is generated for the state machine",
    """The component has `statemachine "x.smdsl";`. This version generates the component without it:
its life cycle (initialize, compute, emergency, restore, finalize) is there, its own states are not.
The line can stay; until then, keep the state in an attribute and look at it in `compute`.""",
)

MISSING_METHOD = Code(
    "RC611",
    Severity.WARNING,
    "an operation has no method in the user's class",
    """The component implements or subscribes to an interface, and `specificworker.py` has no method
for one of its operations. Until there is one, a caller gets `RemoteError`, and a message of a topic
is dropped with a line in the log.

The method is called `<port>_<operation>` and takes the inputs of the operation in order:

    def Speech_say(self, req: DatasayReq) -> tuple[int, DatasayResp]:
        return 0, DatasayResp()

`generated/genericworker.py` has its signature. rcgen never changes a file that is yours.""",
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

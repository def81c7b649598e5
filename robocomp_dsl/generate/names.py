"""Names of a model as Python names: the rules by which they change, all in one place.

In: names of IDSL, CDSL and PDSL. Out: identifiers that clash with nothing. Most names stay as they
are; `id`, `type` and `len` do too. The wire, the interfaces and the configuration always keep the
name as written. The rules, in order:

1. Leading underscores move to the end: `_x` is `x_`. (Python gives them a meaning in classes.)
2. A keyword and `self` get a trailing underscore: `None_`, `lambda_`.
3. So does what the place itself needs: a type that is called as a Python builtin or as a name that
   generated modules use (`list_`), a field or operation that is called as a member of its base
   class (`close_`).
4. Two modules that declare the same name: both become `<Module>_<Name>`.
5. What still clashes gets further underscores, in order of declaration.
"""

from __future__ import annotations

import keyword
from collections import Counter
from collections.abc import Iterable, Sequence

from robocomp_dsl.model.types import Declaration

_BUILTINS = """ArithmeticError AssertionError AttributeError BaseException BaseExceptionGroup
BlockingIOError BrokenPipeError BufferError BytesWarning ChildProcessError
ConnectionAbortedError ConnectionError ConnectionRefusedError ConnectionResetError
DeprecationWarning EOFError Ellipsis EncodingWarning EnvironmentError Exception ExceptionGroup
FileExistsError FileNotFoundError FloatingPointError FutureWarning GeneratorExit IOError
ImportError ImportWarning IndentationError IndexError InterruptedError IsADirectoryError
KeyError KeyboardInterrupt LookupError MemoryError ModuleNotFoundError NameError
NotADirectoryError NotImplemented NotImplementedError OSError OverflowError
PendingDeprecationWarning PermissionError ProcessLookupError PythonFinalizationError
RecursionError ReferenceError ResourceWarning RuntimeError RuntimeWarning StopAsyncIteration
StopIteration SyntaxError SyntaxWarning SystemError SystemExit TabError TimeoutError TypeError
UnboundLocalError UnicodeDecodeError UnicodeEncodeError UnicodeError UnicodeTranslateError
UnicodeWarning UserWarning ValueError Warning ZeroDivisionError abs aiter all anext any ascii
bin bool breakpoint bytearray bytes callable chr classmethod compile complex copyright credits
delattr dict dir divmod enumerate eval exec exit filter float format frozenset getattr globals
hasattr hash help hex id input int isinstance issubclass iter len license list locals map max
memoryview min next object oct open ord pow print property quit range repr reversed round set
setattr slice sorted staticmethod str sum super tuple type vars zip"""
BUILTINS = frozenset(_BUILTINS.split())
"""Python's own names; a list, because `dir(builtins)` differs between versions."""

_MODULE = """INTERFACE SCHEMA SPEC annotations np rt main generated interfaces params genericworker
specificworker Any Callable overload Literal GenericWorker SpecificWorker Component ComponentSpec
CalledPort ServedPort Group Parameter ParameterGroup Parameters initialize compute emergency restore
finalize"""
MODULE = frozenset(_MODULE.split())
"""What generated modules and their classes call things that are not the user's."""

ANNOTATION = frozenset(
    ("bool", "int", "float", "str", "list", "dict", "tuple", "rt", "np", "Any", "Callable")
)
"""What annotations inside a class may mention; a member of that name would hide it from mypy."""


ENUM_MEMBERS = frozenset(
    (
        "as_integer_ratio",
        "bit_count",
        "bit_length",
        "conjugate",
        "denominator",
        "from_bytes",
        "imag",
        "is_integer",
        "mro",
        "name",
        "numerator",
        "real",
        "to_bytes",
        "value",
    )
)
"""What an `IntEnum` has itself."""


STRUCT_MEMBERS = frozenset(("np",))
"""Names that a struct needs itself: a field of that name gets an underscore."""

ERROR_MEMBERS = STRUCT_MEMBERS | {"add_note", "args", "with_traceback"}
"""The same for declared exceptions, with the public members of their base."""

ARGUMENTS = frozenset(("rt", "super"))
"""Names that the bodies of methods need."""

ARRAY_MEMBERS = frozenset(
    (
        "append",
        "clear",
        "column",
        "copy",
        "count",
        "extend",
        "from_columns",
        "index",
        "insert",
        "nested",
        "pop",
        "remove",
        "reverse",
        "sort",
    )
)
"""Public members of the base of all arrays of records."""

PROXY_MEMBERS = frozenset(("INTERFACE", "is_heard", "set_timeout", "wait_for_server"))
"""Public members of the base of all proxies."""

COMPONENT_MEMBERS = frozenset(
    (
        "SPEC",
        "clock",
        "compute",
        "config_file",
        "declare_emergency",
        "emergency",
        "end_emergency",
        "finalize",
        "initialize",
        "log",
        "machine",
        "name",
        "params",
        "quit",
        "restore",
        "set_period",
    )
)
"""Public members of the base of all components; an operation or proxy never hides one."""

PARAMETER_MEMBERS = frozenset(
    ("SCHEMA", "bind", "describe", "load", "save", "set", "set_text", "values", "Literal")
)
"""Public members of the base of all parameters, and what the annotations mention."""


def identifier(name: str, reserved: Iterable[str] = ()) -> str:
    """`name` by the rules 1 to 3; `reserved` is what the place itself needs."""
    bare = name.lstrip("_")
    moved = bare + "_" * (len(name) - len(bare))
    if not bare or bare[0].isdigit():
        moved = f"n{moved}"
    hurts = keyword.iskeyword(moved) or moved == "self" or moved in reserved
    return f"{moved}_" if hurts else moved


class Scope:
    """The names of one place; rule 5."""

    def __init__(self, reserved: Iterable[str] = ()) -> None:
        self.reserved = frozenset(reserved)
        self.taken = set(self.reserved)

    def claim(self, name: str) -> str:
        """A free identifier for `name`, which is taken from now on."""
        found = identifier(name, self.reserved)
        while found in self.taken:
            found += "_"
        self.taken.add(found)
        return found


def unique(names: Sequence[str], reserved: Iterable[str] = ()) -> tuple[str, ...]:
    """Identifiers for the names of one place, in order."""
    scope = Scope(reserved)
    return tuple(scope.claim(name) for name in names)


def of_declarations(declarations: Sequence[Declaration]) -> tuple[dict[Declaration, str], Scope]:
    """Names for the types of all modules together, and the scope for what else stands there."""
    scope = Scope(BUILTINS | MODULE)
    count = Counter(d.name for d in declarations)
    wanted = {d: f"{d.module}_{d.name}" if count[d.name] > 1 else d.name for d in declarations}
    # Those that need no change keep their names, whoever was declared first.
    order = sorted(declarations, key=lambda d: identifier(wanted[d], scope.reserved) != d.name)
    found = {d: scope.claim(wanted[d]) for d in order}
    return found, scope


def camel(name: str) -> str:
    """`my_arm` as `MyArm`: the first part of the name of a class."""
    return "".join(part[:1].upper() + part[1:] for part in name.split("_"))

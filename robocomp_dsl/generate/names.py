"""Convert names of a model to Python names: all rules in one place.

In: names of IDSL, CDSL and PDSL. Out: identifiers without clashes. Most names are unchanged, also
`id`, `type` and `len`. Messages, interfaces and configurations always use the original names.
The rules, in order:

1. Leading underscores move to the end: `_x` is `x_`. (They have a meaning in Python classes.)
2. A keyword and `self` get a trailing underscore: `None_`, `lambda_`.
3. So do names that the scope reserves: a type named like a Python builtin or like a name that
   generated modules use (`list_`), a field or operation named like a member of its base class
   (`close_`).
4. Two modules that declare the same name: both become `<Module>_<Name>`.
5. Names that still clash get further underscores, in order of declaration.
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

_MODULE = """INTERFACE SCHEMA SPEC annotations np rt main interfaces params genericworker
specificworker Annotated Any Callable overload Literal GenericWorker SpecificWorker Component
ComponentSpec CalledPort ServedPort Group Parameter ParameterGroup Parameters initialize compute
emergency restore finalize"""
MODULE = frozenset(_MODULE.split())
"""Names of generated modules and classes that are not the user's."""

ANNOTATION = frozenset(
    ("bool", "int", "float", "str", "list", "dict", "tuple", "rt", "np", "Any", "Callable")
)
"""Names in annotations inside a class; a member of that name would hide it from mypy."""


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
"""Members of `IntEnum`."""


STRUCT_MEMBERS = frozenset(("rt",))
"""Names that a struct needs itself: a field of that name gets an underscore."""

ERROR_MEMBERS = STRUCT_MEMBERS | {"add_note", "args", "with_traceback"}
"""The same for declared exceptions, with the public members of their base."""

ARGUMENTS = frozenset(("rt", "super"))
"""Names used in the bodies of methods."""

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
"""Public members of the base of all struct arrays."""

PROXY_MEMBERS = frozenset(
    ("INTERFACE", "has_subscribers", "is_heard", "set_timeout", "wait_for_server")
)
"""Public members of the base of all proxies."""

COMPONENT_MEMBERS = frozenset(
    (
        "SPEC",
        "clock",
        "compute",
        "config_file",
        "deadline_missed",
        "declare_emergency",
        "emergency",
        "end_emergency",
        "finalize",
        "initialize",
        "log",
        "machine",
        "name",
        "params",
        "publisher_alive",
        "publisher_lost",
        "quit",
        "restore",
        "set_period",
    )
)
"""Public members of the base of all components; operations and proxies never hide them."""

PARAMETER_MEMBERS = frozenset(
    ("SCHEMA", "bind", "describe", "load", "save", "set", "set_text", "values", "Literal")
)
"""Public members of the base of all parameters, and names in annotations."""


def identifier(name: str, reserved: Iterable[str] = ()) -> str:
    """`name` by the rules 1 to 3; `reserved` are the reserved names of the scope."""
    bare = name.lstrip("_")
    moved = bare + "_" * (len(name) - len(bare))
    if not bare or bare[0].isdigit():
        moved = f"n{moved}"
    hurts = keyword.iskeyword(moved) or moved == "self" or moved in reserved
    return f"{moved}_" if hurts else moved


class NameScope:
    """The names of one scope; rule 5."""

    def __init__(self, reserved: Iterable[str] = ()) -> None:
        self.reserved = frozenset(reserved)
        self.taken = set(self.reserved)

    def claim(self, name: str) -> str:
        """A free identifier for `name`; it is reserved from now on."""
        free = identifier(name, self.reserved)
        while free in self.taken:
            free += "_"
        self.taken.add(free)
        return free


def unique(names: Sequence[str], reserved: Iterable[str] = ()) -> tuple[str, ...]:
    """Identifiers for the names of one scope, in order."""
    scope = NameScope(reserved)
    return tuple(scope.claim(name) for name in names)


def of_declarations(
    declarations: Sequence[Declaration],
) -> tuple[dict[Declaration, str], NameScope]:
    """Names for the types of all modules, and the scope for further names."""
    scope = NameScope(BUILTINS | MODULE)
    count = Counter(d.name for d in declarations)
    candidates = {d: f"{d.module}_{d.name}" if count[d.name] > 1 else d.name for d in declarations}
    # Valid names are claimed first, so that they stay unchanged.
    order = sorted(declarations, key=lambda d: identifier(candidates[d], scope.reserved) != d.name)
    names = {d: scope.claim(candidates[d]) for d in order}
    return names, scope


def camel(name: str) -> str:
    """`my_arm` as `MyArm`: the first part of the name of a class."""
    return "".join(part[:1].upper() + part[1:] for part in name.split("_"))


def package_of(component: str) -> str:
    """The package of the generated code of a component, in lower case as Python packages are."""
    return f"{component.lower()}_generated"

"""Random valid IDSL: two files, one importing the other, difficult names, any order."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from hypothesis import strategies as st

_NAMES = """a A b B aB ab AB x X x2 pose Pose POSE poseList Pose_List
pose_list posePtr PosePrx Helper
aHolder ice Ice iceBox IceBox
Ice_ _a a_ a__b __ _ _1 n n1 data Data key value entry ok error Error
Object LocalObject Value class Class optional tag local const extends unused True None lambda self
id type len int32 uint8 string_ bool_ M N Base Text Entry PoseEntry PoseList HTTPServer getX2Y a1 A1
EKeyValue request response Request Response goRequest constructor default namespace template
return_value LONG_NAME time Time duration char wstring float32 Header header"""
NAMES = _NAMES.split()
PRIMITIVES = ("bool", "byte", "short", "int", "long", "float", "double", "string")
KEYS = ("byte", "short", "int", "long", "string", "bool")
DEFAULTS = {
    "bool": ("true", "false"),
    "byte": ("0", "255"),
    "short": ("-32768", "7"),
    "int": ("2147483647", "-2147483648"),
    "long": ("-9223372036854775808", "9223372036854775807"),
    "float": ("1", "-0.0", "1e-30", "3.4e38"),
    "double": ("1e300", "0.1", "12345678901234567890"),
    "string": ('""', '"a # b"', r'"\"q\" \\ \n é 机"', '"it\'s"', '" x "', '"// /* "'),
}
DOCS = (
    "",
    "/** A comment. */ ",
    "/** One,\n two: # é 机 \\ % {@link x} [mm]\n\n  = 3 */ ",
    "/// */* ---\n",
    "/** @param q x */ ",
)


@dataclass
class RandomModule:
    """The types declared so far, and the texts of declarations."""

    draw: Callable[..., object]
    types: list[str] = field(default_factory=lambda: list(PRIMITIVES))
    keys: list[str] = field(default_factory=lambda: list(KEYS))
    errors: list[str] = field(default_factory=list)
    enums: dict[str, list[str]] = field(default_factory=dict)

    def choice(self, among: list[str] | tuple[str, ...]) -> str:
        return str(self.draw(st.sampled_from(among)))

    def names(self, least: int, most: int) -> list[str]:
        drawn = self.draw(
            st.lists(st.sampled_from(NAMES), min_size=least, max_size=most, unique=True)
        )
        assert isinstance(drawn, list)
        return drawn

    def type(self) -> str:
        # The newest are drawn more often: that nests them.
        return self.choice(self.types[-4:]) if self.draw(st.booleans()) else self.choice(self.types)

    def fields(self, least: int = 0) -> str:
        return "".join(f"{self.choice(DOCS)}{self.field(name)}" for name in self.names(least, 5))

    def field(self, name: str) -> str:
        type_ = self.type()
        unit = " [mm]" if type_ in PRIMITIVES[1:7] and self.draw(st.booleans()) else ""
        choices = DEFAULTS.get(type_, ()) or tuple(self.enums.get(type_, ()))
        default = f" = {self.choice(choices)}" if choices and self.draw(st.booleans()) else ""
        return f"{type_} {name}{unit}{default};"

    def declaration(self, name: str, module: str) -> str:
        kinds = ("struct", "struct", "enum", "exception", "sequence", "dictionary", "interface")
        kind = self.choice(kinds)
        text = getattr(self, kind)(name)
        known = f"{module}::{name}"
        if kind in ("struct", "enum", "sequence", "dictionary"):
            self.types.append(known)
        if kind == "enum":
            self.enums[known] = self.enums.pop(name)
            self.keys.append(known)
        if kind == "exception":
            self.errors.append(known)
        return f"{self.choice(DOCS)}{text}\n"

    def struct(self, name: str) -> str:
        return f"struct {name} {{ {self.fields()} }};"

    def exception(self, name: str) -> str:
        return f"exception {name} {{ {self.fields()} }};"

    def enum(self, name: str) -> str:
        self.enums[name] = self.names(1, 5)
        step = self.draw(st.integers(1, 3))
        numbered = (
            f"{value} = {number * int(str(step))}" for number, value in enumerate(self.enums[name])
        )
        return f"enum {name} {{ {', '.join(numbered)} }};"

    def sequence(self, name: str) -> str:
        return f"sequence<{self.type()}> {name};"

    def dictionary(self, name: str) -> str:
        return f"dictionary<{self.choice(self.keys)}, {self.type()}> {name};"

    def interface(self, name: str) -> str:
        return f"interface {name} {{ {' '.join(map(self.operation, self.names(0, 4)))} }};"

    def operation(self, name: str) -> str:
        called = self.names(0, 4)
        outs = [self.draw(st.booleans()) for _ in called]
        result = "void" if self.draw(st.booleans()) else self.type()
        thrown = (
            self.draw(st.lists(st.sampled_from(self.errors), max_size=2)) if self.errors else []
        )
        assert isinstance(thrown, list)
        throws = f" throws {', '.join(thrown)}" if thrown else ""
        mark = self.choice(("", "", "idempotent "))
        if result == "void" and not any(outs) and not thrown:
            mark = self.choice(("", "[command] ", "[query] "))
        parameters = ", ".join(
            f"{'out ' if out else ''}{self.type()} {parameter}"
            for parameter, out in zip(called, outs, strict=True)
        )
        return f"{self.choice(DOCS)}{mark}{result} {name}({parameters}){throws};"


@st.composite
def texts(draw: Callable[..., object]) -> dict[str, str]:
    """File name to text; `Text.idsl` is the one to export, and it imports `Base.idsl`."""
    drawn = RandomModule(draw)
    base, text = (
        drawn.choice(("Base", "IceBase", "base", "a_b")),
        drawn.choice(("M", "Text", "pose")),
    )
    bodies = {}
    for module in (base, text):
        rows = [drawn.declaration(name, module) for name in drawn.names(1, 8)]
        shuffled = draw(st.permutations(rows))
        assert isinstance(shuffled, list)
        bodies[module] = "".join(shuffled)
    return {
        "Base.idsl": f"module {base} {{\n{bodies[base]}}};\n",
        "Text.idsl": f'import "Base.idsl";\nmodule {text} {{\n{bodies[text]}}};\n',
    }

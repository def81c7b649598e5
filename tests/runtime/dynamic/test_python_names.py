"""The names of dynamic types are those that the generator would choose."""

from __future__ import annotations

from hypothesis import given
from hypothesis import strategies as st

from robocomp_dsl.generate import names
from robocomp_dsl.runtime.dynamic import python_names

identifiers = st.from_regex(r"[A-Za-z_][A-Za-z0-9_]{0,6}", fullmatch=True) | st.sampled_from(
    ["self", "None", "lambda", "mro", "name", "rt", "args", "_", "__", "_1"]
)


def test_reserved_python_names_are_those_of_the_generator() -> None:
    assert python_names.STRUCT_MEMBERS == names.STRUCT_MEMBERS
    assert python_names.ERROR_MEMBERS == names.ERROR_MEMBERS
    assert python_names.ENUM_MEMBERS == names.ENUM_MEMBERS


@given(st.lists(identifiers, max_size=6))
def test_python_names_are_those_of_the_generator(fields: list[str]) -> None:
    for reserved in (python_names.STRUCT_MEMBERS, python_names.ENUM_MEMBERS):
        assert python_names.unique_names(fields, reserved) == list(names.unique(fields, reserved))

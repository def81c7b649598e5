"""What the message of `InterfaceMismatch` says of two shapes."""

from __future__ import annotations

import pytest

from robocomp_dsl.runtime.data.shape_difference import describe_difference

HERE = (
    "query pick(b:struct{ripeness:float,where:struct{x:float[mm],y:double}},n:int)"
    "->(:int,o:sequence<struct{a:int}>) throws(struct{code:int})"
)


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        (
            "ripeness:float,",
            "ripeness:float,weight:float[kg],",
            "`weight` of `b` (`float [kg]`) is new there between `ripeness` and `where`",
        ),
        (
            "ripeness:float,",
            "",
            "`ripeness` of `b` (`float`) is missing there before `where`",
        ),
        ("x:float[mm]", "x:float[m]", "`b.where.x` is in mm here, but in m there"),
        ("x:float[mm]", "x:float", "`b.where.x` is in mm here, but without unit there"),
        (
            "y:double",
            "y:array<uint32,3>",
            "`b.where.y` is `double` here, but `unsigned int[3]` there",
        ),
        ("(:int", "(:long", "`the result` is `int` here, but `long` there"),
        ("{a:int}", "{a:double}", "`o[].a` is `int` here, but `double` there"),
        (",n:int", "", "the input `n` (`int`) is missing there after `b`"),
        ("query", "command", "it is a query here, but a command there"),
        ("throws(struct{code:int})", "throws()", "it throws 1 exceptions here, but 0 there"),
        ("{code:int}", "{code:short}", "`exception 1.code` is `int` here, but `short` there"),
        ("n:int", "n:enum{A=0,B=1}", "`n` is `int` here, but `enum{A=0,B=1}` there"),
        (HERE, "nonsense", "its types differ"),
        (HERE, "query pick((((", "its types differ"),
        (HERE, HERE, ""),
    ],
)
def test_describe_difference_names_field_and_types(old: str, new: str, expected: str) -> None:
    assert describe_difference(HERE, HERE.replace(old, new, 1)) == expected


def test_describe_difference_of_enumerations() -> None:
    here, there = (
        f"query f(kind:enum{{{values}}})->() throws()" for values in ("A=0,C=2", "A=0,B=1,C=2")
    )
    expected = "the value `B` of `kind` is new there between `A` and `C`"
    assert describe_difference(here, there) == expected
    there = here.replace("C=2", "C=3")
    assert describe_difference(here, there) == "the value `C` of `kind` is 2 here, but 3 there"

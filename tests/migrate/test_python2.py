"""Conversion of Python 2: syntax, results of `/` and `round`, and what remains in doubt."""

from __future__ import annotations

import ast

import numpy as np
import pytest

from robocomp_dsl.migrate.python2 import CannotConvert, convert, looks_like_python2
from robocomp_dsl.runtime.robocomp.python2 import divide, round_half_up

HELPERS = "from robocomp_dsl.runtime.robocomp.python2 import "


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("print 'a', b,\n", "print('a', b, end=' ')\n"),
        ("try:\n\tx()\nexcept Ice.Exception, e:\n\tprint e\n",
         "try:\n\tx()\nexcept Ice.Exception as e:\n\tprint(e)\n"),
        ("for i in xrange(3): d.has_key(i)  # c\n", "for i in range(3): i in d  # c\n"),
        ("k = d.keys()\n", "k = list(d.keys())\n"),
        ("x = 480 / 2 - 7 / 2\n", "x = 480 // 2 - 7 // 2\n"),
        ("x = a / 2.0 + float(b) / c\n", "x = a / 2.0 + float(b) / c\n"),
        ("from __future__ import division\nx = a / b\n",
         "from __future__ import division\nx = a / b\n"),
        ("x = (a + 1) / (b)\n", HELPERS + "divide\nx = divide((a + 1) , (b))\n"),
        ("x = a / b / 3\n", HELPERS + "divide\nx = divide(divide(a , b) , 3)\n"),
        ("s.x /= 1 + 2\n", HELPERS + "divide\ns.x = divide(s.x, 1 + 2)\n"),
        ("x = (a /  # a / b\n  b)\n", HELPERS + "divide\nx = (divide(a ,  # a / b\n  b))\n"),
        ("'d'\nx = round(a)\n", f"'d'\n{HELPERS}round_half_up\nx = round_half_up(a)\n"),
        ("print 'no end'", "print('no end')\n"),
    ],
)  # fmt: skip
def test_convert_keeps_meaning_of_python_2(old: str, new: str) -> None:
    assert convert(old).text == new


def test_convert_reads_tabs_as_python_2() -> None:
    text = 'class A:\n        k = 1\n\tdef f(self):\n\t    """a\n\tb"""\n\t    print 1\n'
    converted = convert(text).text
    ast.parse(converted)
    assert '"""a\n\tb"""' in converted


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("x = 1\ny = cmp(a, b)\n", 2),
        ("s = subprocess.check_output(c)\n", 1),
        ("class A:\n    def __cmp__(self, o): return 0\n", 2),
    ],
)
def test_convert_lists_doubts_with_lines(text: str, line: int) -> None:
    assert [number for number, _ in convert(text).doubts] == [line]


@pytest.mark.parametrize(
    "text", ["def x(:\n", "print 'x\n", "x = (\n", "\tx = 1\n  y\n", "if x:\n"]
)
def test_convert_rejects_what_is_not_python(text: str) -> None:
    with pytest.raises(CannotConvert, match="Python 2"):
        convert(text)


@pytest.mark.parametrize(
    ("text", "is_old"),
    [
        ("print x\n", True),
        ("raise E, 'x'\n", True),
        ("for i in xrange(2): pass\n", True),
        ("import ConfigParser\n", True),
        ("print(x)\n", False),
        ("raise E('x')\n", False),
        ("exec('x')\n", False),
        ("import configparser\nunicode = str\n", False),
    ],
)
def test_looks_like_python2(text: str, is_old: bool) -> None:
    assert looks_like_python2(text) == is_old


def test_divide_has_results_of_python_2() -> None:
    assert [divide(7, 2), divide(-7, 2), divide(7.0, 2), divide(True, 2)] == [3, -4, 3.5, 0]
    assert divide(np.array([5, 7]), 2).tolist() == [2, 3]
    assert divide(np.array([5, 7]), 2.0).tolist() == [2.5, 3.5]


def test_round_half_up_has_results_of_python_2() -> None:
    assert [round_half_up(x) for x in (0.5, 1.5, 2.5, -0.5, -2.5)] == [1, 2, 3, -1, -3]
    assert isinstance(round_half_up(2), float)
    assert round_half_up(1.25, 1) == 1.3

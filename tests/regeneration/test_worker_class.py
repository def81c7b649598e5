"""The worker class of the user: other names, other modules, bases that rcgen cannot see."""

from __future__ import annotations

import pytest

from tests.regeneration.talker_component import WORKER_HEAD, TalkerComponent

WITHIN = "from talker_generated.genericworker import GenericWorker\nif True:\n    "

# Module of the user, base module, and expected message about `say`.
ELSEWHERE = {
    "in an if": (f"{WITHIN}class SpecificWorker(GenericWorker): pass\n", "", "at the margin"),
    "another name": (
        f"{WORKER_HEAD.replace('Specific', 'My')}    pass\nSpecificWorker = MyWorker\n",
        "",
        "`MyWorker` has no method for the operation `say`; this stub was added",
    ),
    "two workers": (
        f"{WORKER_HEAD.replace('Specific', 'My')}    pass\n\n"
        "class Other(MyWorker):\n    pass\n\nSpecificWorker = Other if True else MyWorker\n",
        "",
        "what its base `SpecificWorker` has cannot be seen here",
    ),
    "the second of two workers": (
        f"{WORKER_HEAD.replace('Specific', 'My')}    pass\n\n"
        "class SpecificWorker(MyWorker):\n    pass\n",
        "",
        "`SpecificWorker` has no method for the operation `say`; this stub was added",
    ),
    "all in another file": (
        "from mine import SpecificWorker\n",
        f"{WORKER_HEAD}    pass\n",
        "margin",
    ),
    "a base beside it": (
        f"from mine import Mix as M\n{WORKER_HEAD.replace('(', '(M, ')}    pass\n",
        "class Mix:\n    def Talk_say(self, w): return 1\n",
        "",
    ),
    "a qualified base beside it": (
        f"import mine\n{WORKER_HEAD.replace('(', '(mine.Mix, ')}    pass\n",
        "class Mix:\n    def Talk_say(self, w): return 1\n",
        "",
    ),
    "a base that lacks it": (
        f"from mine import Mix\n{WORKER_HEAD.replace('(', '(Mix, ')}    pass\n",
        "class Mix:\n    def Talk_other(self, w): return 1\n",
        "this stub was added",
    ),
    "an unknown base": (
        f"from enum import Enum as Mix\n{WORKER_HEAD.replace('(', '(Mix, ')}    pass\n",
        "",
        "what its base `Mix` has cannot be seen here",
    ),
    "in an if in the class": (
        f"{WORKER_HEAD}    if True:\n        def Talk_say(s, w): ...\n",
        "",
        "",
    ),
    "in a match in the class": (
        f"{WORKER_HEAD}    match 1:\n        case _:\n            def Talk_say(s, w): ...\n",
        "",
        "",
    ),
    "in a circle": ("from mine import SpecificWorker\n", "from specificworker import *\n", "seen"),
}


@pytest.mark.parametrize("case", ELSEWHERE)
def test_worker_class_defined_elsewhere_is_resolved_or_reported(
    talker: TalkerComponent, case: str
) -> None:
    text, base_module, expected = ELSEWHERE[case]
    talker.describe("")
    talker.worker.unlink()
    talker.generate()
    talker.worker.write_text(text)
    (talker.folder / "mine.py").write_text(base_module)
    talker.describe("int say(Word w);")
    found = talker.generate()
    assert [d.code.id for d in found] == (["RC611"] if expected else [])
    assert expected in "".join(d.message for d in found)
    if "added" not in expected or "none" in expected:
        assert talker.worker.read_text() == text


def test_base_class_in_other_module_is_checked(talker: TalkerComponent) -> None:
    base_module = talker.folder / "mine.py"
    base_module.write_text("class Mix:\n    def Talk_say(self, w) -> int: return self.params.rat\n")
    talker.worker.write_text(
        f"from mine import Mix\n{WORKER_HEAD.replace('(', '(Mix, ')}    pass\n"
    )
    talker.describe("int say(Word w, int n);", parameters="rate float 1;")
    found = talker.generate()
    assert {(d.code.id, d.span.text) for d in found} == {("RC615", "Talk_say"), ("RC616", "rat")}
    assert {d.span.source.path for d in found} == {base_module}

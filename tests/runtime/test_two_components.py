"""Two components in one process: their generated packages have names of their own."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from robocomp_dsl.check.passes import check_cdsl
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.plan import plan
from robocomp_dsl.generate.write import write

IDSL = """\
module Sums
{
    exception TooMany { int limit; };
    struct Numbers { int a; int b; };
    interface Adder { int add(Numbers numbers) throws TooMany; };
};
"""
CDSL = """\
import "Sums.idsl";
Component %s { Communications { %s Adder; }; language Python; middleware inproc; };
"""
PROGRAM = """
import sys
sys.path[:0] = ["adder", "asker"]
import adder_generated.interfaces as served
import asker_generated.interfaces as called
from adder_generated.genericworker import GenericWorker as AdderBase
from asker_generated.genericworker import GenericWorker as AskerBase
from robocomp_dsl.runtime.component.runner import Runner
from robocomp_dsl.runtime.component.settings import RunSettings

class Adder(AdderBase):
    def Adder_add(self, numbers: served.Numbers) -> int:
        if numbers.a > 9:
            raise served.TooMany(limit=9)
        return numbers.a + numbers.b

class Asker(AskerBase):
    def initialize(self):
        assert self.adder_proxy.wait_for_server(60)
        print(self.adder_proxy.add(called.Numbers(2, b=3)))
        print(self.adder_proxy.query(called.Numbers(3, 4)))
        try:
            self.adder_proxy.add(called.Numbers(10))
        except called.TooMany as error:
            print(error)
        self.quit()

assert served.Numbers is not called.Numbers
runners = [
    Runner(cls, cls.SPEC.parameters.load(None, ()), RunSettings(domain="two"))
    for cls in (Adder, Asker)
]
for runner in runners:
    runner.start()
assert runners[1].wait()
runners[0].stop()
assert runners[0].wait()
"""


def test_two_components_call_each_other_in_one_process(tmp_path: Path) -> None:
    (tmp_path / "Sums.idsl").write_text(IDSL)
    for name, role in (("adder", "implements"), ("asker", "requires")):
        folder = tmp_path / name
        folder.mkdir()
        (folder / "Sums.idsl").write_text(IDSL)
        (folder / f"{name}.cdsl").write_text(CDSL % (name, role))
        report = Report()
        component = check_cdsl(folder / f"{name}.cdsl", Workspace(environ={}), report)
        assert component is not None
        write(folder, plan(component))
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines() == ["5", "7", "TooMany(limit=9)"]

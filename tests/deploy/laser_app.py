"""A deployment of `arm` and `eye`, and commands on it, for the tests of `rcdeploy up`."""

from __future__ import annotations

import json
import re
from typing import Any

from tests.deploy.rcdeploy_process import RunningProcess, rcdeploy, start_rcdeploy

ARM = """
class SpecificWorker(GenericWorker):
    def initialize(self):
        print("arm begins with", self.params.serial, self.params.rate, os.environ.get("MODE"))
    def finalize(self):
        print("arm finalizes")
    def Laser_getLaserData(self):
        self.log.info("asked by a client")
        return TLaserData([TData(0.5, float(os.getpid()))])
"""
EYE = """
class SpecificWorker(GenericWorker):
    seen = 0
    def compute(self):
        server = int(self.laser_proxy.getLaserData()[0].dist)
        if server != self.seen:
            print("eye sees a new arm", server)
        self.seen = server
    def finalize(self):
        print("eye finalizes")
"""
APP = """
import "arm/arm.cdsl";
import "eye/eye.cdsl";
Deployment app
{
    component arm { set serial = "abc"; set rate = 20; env MODE = fast; ready within 200 s; };
    component eye { after arm; ready within 200 s; };
};
"""


def start_app(*arguments: str) -> RunningProcess:
    """Start `rcdeploy` on `app.ddsl` of the working folder."""
    return start_rcdeploy("app.ddsl", *arguments)


def status(name: str = "app") -> dict[str, Any]:
    answer = rcdeploy("status", name, "--format", "json")
    assert answer.stdout, answer.stderr
    found: dict[str, Any] = json.loads(answer.stdout)
    return found


def last_number(line: str) -> int:
    """The last number of a line."""
    return int(re.findall(r"\d+", line)[-1])


GROUPED_APP = """
import "arm/arm.cdsl";
import "eye/eye.cdsl";
Deployment app
{
    host desk { address "127.0.0.1"; };
    group left on desk
    {
        component arm { set serial = "abc"; ready within 200 s; };
        component eye { after arm; ready within 200 s; };
        export Laser from arm;
    };
    component eye on localhost { after left; ready within 200 s; };
};
"""

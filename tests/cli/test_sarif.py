"""`--format sarif`: required content of logs (SARIF 2.1.0, section in brackets)."""

from __future__ import annotations

import json
from pathlib import Path

from tests.cli.rcgen_run import Rcgen

GOOD = (
    'import "Laser.idsl";\nComponent a { Communications { requires Laser; }; language Python; };\n'
)
BAD = (
    'import "Laser.idsl";\nComponent a { Communications { requires Lasr; }; language Python;; };\n'
)


def test_sarif_without_findings_has_no_results(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(GOOD)
    log = json.loads(rcgen("check", "a.cdsl", "--format", "sarif").out)
    assert log["version"] == "2.1.0"
    assert log["runs"][0]["results"] == []  # [3.14.23]: empty, not absent
    assert log["runs"][0]["tool"]["driver"]["name"] == "rcgen"


def test_sarif_results_refer_to_rules_and_locations(rcgen: Rcgen, here: Path) -> None:
    (here / "a b.cdsl").write_text(BAD)
    run = rcgen("check", "a b.cdsl", "--format", "sarif")
    assert run.code == 1
    (only,) = json.loads(run.out)["runs"]
    rules = only["tool"]["driver"]["rules"]
    levels = {}
    for result in only["results"]:
        assert rules[result["ruleIndex"]]["id"] == result["ruleId"]  # [3.27.6]
        place = result["locations"][0]["physicalLocation"]
        assert place["artifactLocation"]["uri"] == "a%20b.cdsl"  # [3.4.3]
        levels[result["level"]] = result
    assert set(levels) == {"error", "warning"}
    region = levels["error"]["locations"][0]["physicalLocation"]["region"]
    assert region == {"startLine": 2, "startColumn": 41, "endLine": 2, "endColumn": 45}


def test_sarif_fix_is_a_replacement(rcgen: Rcgen, here: Path) -> None:
    (here / "a.cdsl").write_text(BAD.replace("Lasr", "Laser"))
    log = json.loads(rcgen("check", "a.cdsl", "--format", "sarif").out)
    (result,) = log["runs"][0]["results"]
    (change,) = result["fixes"][0]["artifactChanges"]  # [3.55.3]
    (replacement,) = change["replacements"]
    assert replacement["insertedContent"] == {"text": ""}
    at = BAD.replace("Lasr", "Laser").splitlines()[1].index(";;") + 2
    deleted = replacement["deletedRegion"]
    assert (deleted["startLine"], deleted["startColumn"], deleted["endColumn"]) == (2, at, at + 1)

"""The counters of the campaign: a campaign that cannot count would always report zero."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from tests.campaign.__main__ import Campaign
from tests.campaign.components import count_calls
from tests.campaign.mutated_bytes import mutated_bytes


@pytest.fixture
def journals(tmp_path: Path) -> Path:
    (tmp_path / "journals").mkdir()
    return tmp_path / "journals"


def test_count_calls_finds_lost_and_doubled_calls(journals: Path) -> None:
    (journals / "acknowledged").write_text("7 1\n7 2\n7 3\n")
    (journals / "executed").write_text("7 1\n7 3\n7 3\n7 4\n")
    assert count_calls(journals.parent) == {
        "acknowledged": 3, "executed": 4, "lost": 1, "doubled": 1,
    }  # fmt: skip


def test_longest_block_counts_calls_and_delays_of_its_section(journals: Path) -> None:
    now = time.monotonic()
    rows = [(now - 9, 5.0, 5.0), (now - 8, 3.0, 0.1), (now, 0.06, 0.01), (now, 0.01, 0.04)]
    (journals / "bystander").write_text("".join(f"{a} {b} {c}\n" for a, b, c in rows))
    campaign = Campaign(journals.parent, 1.0)
    assert campaign.longest_block(now - 1) == pytest.approx(0.05)
    assert campaign.longest_block(now - 8.5) == pytest.approx(2.99)
    assert campaign.longest_block(now + 1) is None


def test_section_reports_a_fault_that_cannot_be_injected(journals: Path) -> None:
    campaign = Campaign(journals.parent, 60.0)
    campaign.section("broken", lambda: 1 / 0)
    assert campaign.failures == ["broken"]
    assert "ZeroDivisionError" in campaign.figures["broken"]["error"]


def test_mutated_bytes_reaches_every_decoder() -> None:
    figures = mutated_bytes(20_000)
    sent = [value for key, value in figures.items() if key.endswith(": bytes")]
    accepted = [value for key, value in figures.items() if key.endswith(": accepted")]
    assert len(sent) == 2
    assert all(value >= 20_000 for value in sent)
    assert all(0 < value < 100 for value in accepted)

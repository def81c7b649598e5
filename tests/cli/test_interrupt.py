"""Ctrl-C ends commands, also those that a script has started in the background."""

from __future__ import annotations

import signal
import subprocess
import sys

import pytest

from tests.support.background_job import IGNORING_INTERRUPT

DEADLINE_S = 120.0
RCGEN = (sys.executable, "-m", "robocomp_dsl.cli.rcgen")


@pytest.mark.parametrize("prefix", [(), IGNORING_INTERRUPT], ids=["foreground", "background"])
def test_sigint_ends_rcgen_view(prefix: tuple[str, ...]) -> None:
    pytest.importorskip("viser", reason="needs the extra `view`: pip install robocomp_dsl[view]")
    with subprocess.Popen(
        [*prefix, *RCGEN, "view", "nao_h25", "--port", "0"], stdout=subprocess.PIPE, text=True
    ) as process:
        try:
            assert process.stdout
            assert "http://127.0.0.1:" in process.stdout.readline()
            process.send_signal(signal.SIGINT)
            assert process.wait(DEADLINE_S) == 130
        finally:
            process.kill()

"""ZeroC's Ice, if it is installed: plain Ice programs are the peers of these tests."""

from __future__ import annotations

import pytest

Ice = pytest.importorskip("Ice", reason="needs ZeroC Ice: `make test-peers` installs it")

from collections.abc import Iterator

import pytest

from tests.simulation.served_worlds import OPEN


@pytest.fixture(autouse=True)
def stopped_simulations() -> Iterator[None]:
    """Stop the simulations of the test: a camera that has drawn holds some 90 MB until then."""
    yield
    while OPEN:
        OPEN.pop().stop()

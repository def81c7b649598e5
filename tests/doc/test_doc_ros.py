"""Documentation of interfaces with ROS types: fields, arrays, constants, links."""

from __future__ import annotations

from tests.doc.doc_site import check_links, pages, read
from tests.generate.golden_cases import GOLDEN


def test_documentation_shows_ros_messages() -> None:
    found = pages(GOLDEN / "ros" / "demo.cdsl")
    assert check_links(found) > 20
    text = read(found["interfaces/Demo.Clouds.html"]).text
    for expected in (
        "struct Cloud",
        "Points with covariance.",
        "double[9]",
        "Point[<=3]",
        "string<=16",
        "[1, 2]",
        "EMPTY octet 0 Nothing was seen.",
        "MAX_RANGE float 12.5",
    ):
        assert expected in text, expected

"""Names that today's Python and numpy do not have are reported with their line."""

from __future__ import annotations

from pathlib import Path

import pytest

from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.regeneration.user_module import parsed
from robocomp_dsl.migrate.review_versions import review_versions
from robocomp_dsl.source import Source


def lines(text: str) -> list[int]:
    """The lines of the findings about a module."""
    report = Report()
    review_versions([parsed(Source(Path("specificworker.py"), text))], report)
    assert {f.code.id for f in report} <= {"RC899"}
    return [f.span.start_position[0] for f in report.sorted()]


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("\nname = unicode(x)\n", 2),
        ("for i in xrange(3): pass\n", 1),
        ("\nif d.has_key(k): pass\n", 2),
        ("for k, v in d.iteritems(): pass\n", 1),
        ("import time\nt = time.clock()\n", 2),
        ("from collections import Mapping\n", 1),
        ("import string as s\nx = s.letters\n", 2),
        ("import numpy as np\ntry:\n    a = np.fromstring(b, np.uint8)\nexcept: pass\n", 3),
        ("import numpy\nx = numpy.float(3)\n", 2),
        ("import pickle\npickle.dump(x, open('a', 'w'))\n", 2),
        ("import pickle\nx = pickle.load(open('a'))\n", 2),
        ("import pickle\nx = pickle.loads(open('a').read())\n", 2),
    ],
)
def test_review_versions_reports_line(text: str, line: int) -> None:
    assert lines(text) == [line]


@pytest.mark.parametrize(
    "text",
    [
        "try:\n    unicode\nexcept NameError:\n    unicode = str\nx = unicode(3)\n",
        "from functools import reduce\nx = reduce(f, y)\n",
        "def f(long): return long\n",
        "has_key = 3\nx.has_key\n",
        "import time\nt = time.time()\nimport os\nx = os.path.join('a')\n",
        "import xml.etree\nx = xml.etree\n",
        "from xml import etree\n",
        "try:\n    from collections import Mapping\nexcept ImportError:\n    pass\n",
        "time = Clock()\nx = time.clock()\nimport time\n",
        "import numpy as np\na = np.fromstring(text, sep=' ')\nb = np.frombuffer(c, np.uint8)\n",
        "import numpy as np\nx = np.bool\n",
        "import pickle\npickle.dump(x, open('a', 'wb'))\nx = pickle.load(open('a', mode='rb'))\n",
        "import pickle\nx = pickle.loads(open('a', 'rb').read())\npickle.dump(x, file)\n",
        "import this_is_nowhere\nx = this_is_nowhere.clock()\n",
    ],
)
def test_review_versions_accepts(text: str) -> None:
    assert lines(text) == []

"""Skins with random numbers are checked and lowered, without exceptions."""

import random
from pathlib import Path

from robocomp_dsl.check.passes import check_innermodel
from robocomp_dsl.check.workspace.workspace import Workspace
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.generate.scene.scene import lower_body

NUMBERS = ("0", "1", "-1", "5", "5", "70", "0.001", "1e300", "-1e9", "30", "1e-300")
COUNTS = ("0", "1", "-1", "8", "640", "2147483647")
FILES = {"good": "0 0 0.01 0 0 1\n", "bad": "nan 0\n"}
ATTRIBUTES = (
    (("x0", "x1", "r0", "r1"), NUMBERS, 0.6),
    (("tx", "rx", "gain", "floor", "saturation"), NUMBERS, 0.3),
    (("count", "firstid"), COUNTS, 0.6),
    (("rings",), ("1,2", "33", "1e300", "0", "-5,5"), 0.4),
    (("file",), (*FILES, "gone", ""), 0.3),
)
TAXEL = ("x", "y", "z", "nx", "ny", "nz", "theta")


def random_attributes(
    rng: random.Random, names: tuple[str, ...], values: tuple[str, ...], probability: float
) -> str:
    return "".join(f' {n}="{rng.choice(values)}"' for n in names if rng.random() < probability)


def skin(seed: int) -> str:
    rng = random.Random(seed)
    count = rng.choice((0, 0, 1, 3))
    taxels = "".join(f"<taxel{random_attributes(rng, TAXEL, NUMBERS, 0.4)}/>" for _ in range(count))
    attributes = "".join(random_attributes(rng, *attribute) for attribute in ATTRIBUTES)
    rate = rng.choice(NUMBERS)
    return f'<skin id="s" rate="{rate}"><patch{attributes}>{taxels}</patch></skin>'


def test_random_skins_are_checked_and_lowered(tmp_path: Path) -> None:
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    world, received = tmp_path / "world.xml", set[str]()
    for seed in range(300):
        world.write_text(f"<innerModel>{skin(seed)}</innerModel>")
        report = Report()
        body = check_innermodel(world, Workspace(()), report)
        assert body is not None
        (result,) = lower_body(body)["skins"]
        assert len(result["patches"]) == 1
        received |= {item.code.id for item in report}
    assert {"RC805", "RC808", "RC821", "RC825"} <= received

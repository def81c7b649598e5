"""`rcgen view` of worlds whose meshes and pictures are elsewhere or missing."""

from pathlib import Path

import numpy as np
import pytest

from robocomp_dsl.cli.rcgen.simulation.view_subject import read_subject
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.simulation.view.picture import Renderer, Viewpoint, scene_extent
from tests.cli.rcgen_run import Rcgen
from tests.cli.test_rcgen_view import pixels
from tests.hardware.mesh_files import TETRAHEDRA


def test_view_reports_missing_files_once(rcgen: Rcgen, tmp_path: Path) -> None:
    path = tmp_path / "world.xml"
    meshes = "".join(f'<mesh id="m{i}" file="/far/a.3ds" scale="100"/>' for i in range(9))
    path.write_text(f'<innerModel>\n  {meshes}<plane id="p" texture="b.png"/></innerModel>')
    result = rcgen("view", str(path), "--screenshot", str(tmp_path / "w.png"), "--size", "64x48")
    assert result.code == 0
    assert "RC788]: 1 mesh not found, a small marker instead in 9 nodes: `m0`" in result.err
    assert "; 1 picture not found, a colour instead in 1 node: `p`" in result.err
    assert "`--files DIR` or ROBOCOMP_FILES=DIR names the folder that has `far/a.3ds`" in result.err
    assert "world.xml:2:3" in result.err
    assert result.err.count("warning") == 1


@pytest.mark.parametrize("by", ["option", "variable", "beside"])
def test_view_finds_meshes_of_other_computer(
    rcgen: Rcgen, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, by: str
) -> None:
    world = tmp_path / "worlds" / "world.xml"
    world.parent.mkdir()
    world.write_text(
        '<innerModel><mesh id="m" file="/home/robocomp/files/osgModels/t.3ds" scale="100"/>'
        "</innerModel>"
    )
    files = world.parent if by == "beside" else tmp_path / "files"
    (files / "osgModels").mkdir(parents=True)
    (files / "osgModels" / "T.3DS").write_bytes(TETRAHEDRA["a.3ds"])
    if by == "variable":
        monkeypatch.setenv("ROBOCOMP_FILES", str(files))
    option = ("--files", files) if by == "option" else ()
    picture = tmp_path / "w.png"
    result = rcgen("view", world, "--screenshot", picture, "--size", "64x48", *option)
    assert (result.code, result.err) == (0, "")
    assert shown_share(picture) > 0.015  # a marker is smaller


MISSING = '<mesh id="{}" file="gone.ive" scale="1000" tx="{}" ty="{}"/>'
ROOM = '<plane id="floor" ny="1" size="4000,4000,10" texture="#ffffff"/>'


@pytest.mark.parametrize(
    ("content", "size", "seen"),
    [
        (ROOM + MISSING.format("m", 100, 40), 4.0, True),
        (ROOM + MISSING.format("far", 10**7, 0), 4.0, False),
        ("".join(MISSING.format(f"m{i}", 100 * i, 0) for i in range(6)), 0.6, True),
        (MISSING.format("m", 0, 0), 0.2, True),
        ('<plane id="p" size="60,60,60"/>' + MISSING.format("m", 100, 0), 0.13, True),
        ('<plane id="p" size="60,60,60"/>' + MISSING.format("m", 900, 0), 0.06, False),
    ],
    ids=["room", "far", "row", "alone", "beside", "away"],
)
def test_view_markers_do_not_rule_the_picture(
    tmp_path: Path, content: str, size: float, seen: bool
) -> None:
    """Each of these meshes was a box of 1 m in the middle of the picture."""
    path = tmp_path / "world.xml"
    path.write_text(f"<innerModel>{content}</innerModel>")
    subject = read_subject(path, (), Report())
    assert subject is not None
    model, data = subject.model, subject.data()
    low, high = scene_extent(model, data)
    assert (high - low).max() == pytest.approx(size, abs=0.11)
    with Renderer(model, 320, 240) as renderer:
        image = renderer.render(data).astype(int)
    orange = (image[:, :, 0] > 1.6 * image[:, :, 1]) & (image[:, :, 0] > 90)
    assert orange.mean() < 0.03
    assert orange.any() == seen


def shown_share(picture: Path) -> float:
    """The share of the pixels that are not sky."""
    image = pixels(picture).astype(int)
    sky = image[:, :4].mean(axis=1, keepdims=True)
    return float((np.abs(image - sky).max(axis=2) > 25).mean())


def test_view_through_camera_has_no_markers(tmp_path: Path) -> None:
    path = tmp_path / "model.xml"
    path.write_text(
        "<mujoco><asset><mesh name='m' file='gone.stl'/></asset><worldbody>"
        "<camera name='eye' pos='0 -.2 0' xyaxes='1 0 0 0 0 1'/><geom type='mesh' mesh='m'/>"
        "</worldbody></mujoco>"
    )
    subject = read_subject(path, (), Report())
    assert subject is not None
    with Renderer(subject.model, 64, 48) as renderer:
        through = renderer.render(subject.data(), Viewpoint(camera="eye")).astype(int)
        around = renderer.render(subject.data()).astype(int)
    assert not (through[:, :, 0] > 1.6 * through[:, :, 1]).any()
    assert (around[:, :, 0] > 1.6 * around[:, :, 1]).any()

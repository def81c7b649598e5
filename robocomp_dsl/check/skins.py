"""The skin of InnerModel bodies: taxels that no patch can have.

In: a resolved body. Out: findings: taxels off the cone of their patch, ids used twice in the body,
files of positions that cannot be read.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from robocomp_dsl.check import codes
from robocomp_dsl.check.tactile import tell
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.hardware.rotations import rotation
from robocomp_dsl.model.body import MOST_MODULES, Body, Patch, Taxel
from robocomp_dsl.source import Span
from robocomp_dsl.tactile.arrays import Floats, Ints
from robocomp_dsl.tactile.errors import DescriptionError
from robocomp_dsl.tactile.skin.positions import TaxelPositions, read_positions
from robocomp_dsl.tactile.skin.triangle import CHANNELS, PRESSURE

OFF_BODY = 15.0
"""A taxel further than this from the cone of its patch is not on it [mm]."""

MM = 1000.0


def judge_skins(body: Body, report: Report) -> None:
    """Add what is wrong with the taxels of `body` to `report`."""
    owner: dict[int, str] = {}
    for node, _ in body.nodes():
        if isinstance(node, Patch):
            read = _read(node, report)
            _judge_ids(node, _ids(node, read), owner, report)
            if node.cone:
                _judge_places(node, _points(node, read), report)


def _place(patch: Patch) -> Span:
    source, start = patch.span.source, patch.span.start
    return source.span(start, start + 1 + len(patch.tag))


def _read(patch: Patch, report: Report) -> TaxelPositions | None:
    """The positions in its file, if it has one that is well."""
    if not patch.file:
        return None
    path = patch.span.source.path.parent / patch.file
    try:
        return read_positions(path.read_text(encoding="utf-8"), path)
    except DescriptionError as error:
        tell(error, patch.span.source, report)
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or error
        said = f"the taxel positions `{patch.file}` cannot be read: {why}"
        report.add(codes.TACTILE_FORM, _place(patch), said)
    return None


def _ids(patch: Patch, read: TaxelPositions | None) -> Ints:
    if patch.rings:
        count = min(max(patch.count, 0), MOST_MODULES)
        modules = np.arange(len(patch.rings) * count) * CHANNELS
        found: Ints = (modules[:, None] + np.array(PRESSURE)).ravel()
    elif read:
        found = np.flatnonzero(read.used)
    else:
        found = np.arange(len(patch.children))
    return found + patch.firstid


def _judge_ids(patch: Patch, ids: Ints, owner: dict[int, str], report: Report) -> None:
    twice = [one for one in ids.tolist() if one in owner]
    if twice:
        said = f"taxel id {twice[0]} of `{patch.id}` is also in `{owner[twice[0]]}`"
        count = "1 id occurs" if len(twice) == 1 else f"{len(twice)} ids occur"
        way = f"{count} twice; choose `firstid` apart"
        report.add(codes.TACTILE_TWICE, _place(patch), said, help=way)
    owner.update(dict.fromkeys(ids.tolist(), patch.id))


def _points(patch: Patch, read: TaxelPositions | None) -> Floats:
    """Rows of x and distance from the axis (mm), in the frame of the patch."""
    if patch.rings:
        return np.array([(x, _radius(patch, x)) for x in patch.rings])
    if read:
        turn = rotation(patch.rx, patch.ry, patch.rz)
        place = np.array((patch.tx, patch.ty, patch.tz))
        x, y, z = ((read.positions[read.used] * MM - place) @ turn).T
        return np.column_stack((x, np.hypot(y, z)))
    return np.array(list(_of_taxels(patch))).reshape(-1, 2)


def _of_taxels(patch: Patch) -> Iterator[tuple[float, float]]:
    for one in patch.children:
        if isinstance(one, Taxel):
            flat = one.theta is not None
            yield one.x, _radius(patch, one.x) if flat else float(np.hypot(one.y, one.z))


def _radius(patch: Patch, x: float) -> float:
    """Of the cone, whose ends go on as they are."""
    return float(np.interp(x, (patch.x0, patch.x1), (patch.r0, patch.r1)))


def _judge_places(patch: Patch, points: Floats, report: Report) -> None:
    if patch.x0 >= patch.x1 or not len(points):
        return
    x, rho = points.T
    beyond = np.maximum(np.maximum(patch.x0 - x, x - patch.x1), 0.0)
    surface = np.interp(x, (patch.x0, patch.x1), (patch.r0, patch.r1))
    away = np.hypot(beyond, rho - surface)
    off = int((away > OFF_BODY).sum())
    if off:
        what = "rings" if patch.rings else "taxels"
        said = f"{off} {what} of `{patch.id}` are off their body, the worst by {away.max():.0f} mm"
        way = f"its cone goes from x = {patch.x0:g} to {patch.x1:g} mm"
        report.add(codes.TAXELS_OFF_BODY, _place(patch), said, help=way)

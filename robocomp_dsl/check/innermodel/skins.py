"""Checks the skins of an InnerModel.

In: a resolved InnerModel. Out: diagnostics: taxels off the cone of their patch, duplicate taxel
ids, taxel position files that cannot be read.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from robocomp_dsl.check.codes import tactile as codes
from robocomp_dsl.check.innermodel.tactile import report_findings
from robocomp_dsl.diagnostics import Report
from robocomp_dsl.hardware.kinematics.rotations import rotation
from robocomp_dsl.model.innermodel import MAX_MODULES, InnerModel, Patch, Taxel
from robocomp_dsl.regular_file import read_text
from robocomp_dsl.source import Span
from robocomp_dsl.tactile.arrays import Floats, Ints
from robocomp_dsl.tactile.errors import DescriptionError
from robocomp_dsl.tactile.skin.positions import TaxelPositions, read_positions
from robocomp_dsl.tactile.skin.triangle import CHANNELS, PRESSURE

OFF_BODY = 15.0
"""Maximum distance of a taxel from the cone of its patch [mm]."""

MM = 1000.0


def check_skins(model: InnerModel, report: Report) -> None:
    """Check the taxels of `body`."""
    owner: dict[int, str] = {}
    for node, _ in model.nodes():
        if isinstance(node, Patch):
            read = _read(node, report)
            _check_ids(node, _ids(node, read), owner, report)
            if node.cone:
                _check_positions(node, _points(node, read), report)


def _place(patch: Patch) -> Span:
    source, start = patch.span.source, patch.span.start
    return source.span(start, start + 1 + len(patch.tag))


def _read(patch: Patch, report: Report) -> TaxelPositions | None:
    """The taxel positions of the patch's file; None without a valid file."""
    if not patch.file:
        return None
    path = patch.span.source.path.parent / patch.file
    try:
        return read_positions(read_text(path), path)
    except DescriptionError as error:
        report_findings(error.findings, patch.span.source, report)
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or error
        message = f"the taxel positions `{patch.file}` cannot be read: {why}"
        report.add(codes.TACTILE_SYNTAX, _place(patch), message)
    return None


def _ids(patch: Patch, read: TaxelPositions | None) -> Ints:
    if patch.rings:
        count = min(max(patch.count, 0), MAX_MODULES)
        modules = np.arange(len(patch.rings) * count) * CHANNELS
        found: Ints = (modules[:, None] + np.array(PRESSURE)).ravel()
    elif read:
        found = np.flatnonzero(read.used)
    else:
        found = np.arange(len(patch.children))
    return found + patch.firstid


def _check_ids(patch: Patch, ids: Ints, owner: dict[int, str], report: Report) -> None:
    twice = [taxel_id for taxel_id in ids.tolist() if taxel_id in owner]
    if twice:
        message = f"taxel id {twice[0]} of `{patch.id}` is also in `{owner[twice[0]]}`"
        count = "1 id occurs" if len(twice) == 1 else f"{len(twice)} ids occur"
        help_text = f"{count} twice; choose another `firstid`"
        report.add(codes.TACTILE_DUPLICATE, _place(patch), message, help=help_text)
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
    for taxel in patch.children:
        if isinstance(taxel, Taxel):
            flat = taxel.theta is not None
            yield taxel.x, _radius(patch, taxel.x) if flat else float(np.hypot(taxel.y, taxel.z))


def _radius(patch: Patch, x: float) -> float:
    """Radius of the cone at `x` [mm]; constant beyond its ends."""
    return float(np.interp(x, (patch.x0, patch.x1), (patch.r0, patch.r1)))


def _check_positions(patch: Patch, points: Floats, report: Report) -> None:
    if patch.x0 >= patch.x1 or not len(points):
        return
    x, rho = points.T
    beyond = np.maximum(np.maximum(patch.x0 - x, x - patch.x1), 0.0)
    surface = np.interp(x, (patch.x0, patch.x1), (patch.r0, patch.r1))
    away = np.hypot(beyond, rho - surface)
    off = int((away > OFF_BODY).sum())
    if off:
        what = "rings" if patch.rings else "taxels"
        message = f"{off} {what} of `{patch.id}` are off its surface, by up to {away.max():.0f} mm"
        help_text = f"its cone extends from x = {patch.x0:g} to {patch.x1:g} mm"
        report.add(codes.TAXELS_OFF_SURFACE, _place(patch), message, help=help_text)

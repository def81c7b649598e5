"""Forces spread over taxels: conserved, local, the same as by a plain loop; sensors; contacts."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from robocomp_dsl.tactile.description.model import GenericPart, Limb, Patch, RobotDescription
from robocomp_dsl.tactile.skin.cone import Cone
from robocomp_dsl.tactile.skin.contacts import contacts
from robocomp_dsl.tactile.skin.geometry import SkinGeometry
from robocomp_dsl.tactile.skin.kernel import ForceKernel
from robocomp_dsl.tactile.skin.layout import place_rings, place_taxels
from robocomp_dsl.tactile.skin.normalise import Sensitivity
from robocomp_dsl.tactile.skin.sensor import Imperfections, Sensor
from robocomp_dsl.tactile.skin.touches import TaxelGraph

CONE = Cone(0.02, 0.10, 0.032, 0.026)
SKIN = place_rings(CONE, (0.033, 0.06, 0.087), 8)
ONE_LIMB = np.zeros(len(SKIN.points), np.int64)
KERNEL = ForceKernel(SKIN.points, ONE_LIMB, 1)

spots = st.tuples(st.floats(0.0, 0.13), st.floats(-3.2, 3.2), st.floats(0.01, 0.06))


def distribute_directly(points, forces, sigma=0.005):
    """The rule as it is written down, contact by contact."""
    felt, missed = np.zeros(len(SKIN.points)), 0.0
    for point, force in zip(points, forces, strict=True):
        distance = np.linalg.norm(SKIN.points - point, axis=1)
        weight = np.where(distance <= 3 * sigma, np.exp(-(distance**2) / (2 * sigma**2)), 0.0)
        if weight.sum() > 0:
            felt += force * weight / weight.sum()
        else:
            missed += force
    return felt, missed


@settings(max_examples=80)
@given(st.lists(spots, min_size=1, max_size=20), st.integers(0, 100))
def test_kernel_grid_matches_direct_sum(places, seed):
    x, theta, rho = np.array(places).T
    points = np.stack((x, rho * np.sin(theta), rho * np.cos(theta)), axis=1)
    forces = np.random.default_rng(seed).uniform(0, 10, len(points))
    share = KERNEL.distribute(points, np.zeros(len(points), np.int64), forces)
    felt, missed = distribute_directly(points, forces)
    assert share.taxel_forces == pytest.approx(felt, abs=1e-9)
    assert share.off_skin == pytest.approx(missed)
    assert share.taxel_forces.sum() + share.off_skin == pytest.approx(forces.sum())


@pytest.mark.parametrize("sigma", [0.001, 0.0049, 0.0051, 0.03])
def test_kernel_of_any_width_matches_direct_sum(sigma):
    rng = np.random.default_rng(1)
    points = SKIN.points[::7] + rng.normal(0.0, sigma, SKIN.points[::7].shape)
    forces = rng.uniform(0, 10, len(points))
    kernel = ForceKernel(SKIN.points, ONE_LIMB, 1, sigma)
    share = kernel.distribute(points, np.zeros(len(points), np.int64), forces)
    felt, missed = distribute_directly(points, forces, sigma)
    assert share.taxel_forces == pytest.approx(felt, abs=1e-9)
    assert share.off_skin == pytest.approx(missed)


def test_kernel_handles_taxels_one_kilometre_apart():
    points = np.array([[0.0, 0, 0], [1000.0, 500.0, -700.0]])
    share = ForceKernel(points, np.zeros(2, np.int64), 1).distribute(
        np.array([[1000.0, 500.0, -700.001], [500.0, 0, 0]]), np.zeros(2, np.int64), np.ones(2)
    )
    assert share.taxel_forces.tolist() == [0.0, 1.0]
    assert share.off_skin == 1.0


def test_kernel_spreads_vectors_with_same_weights():
    points = CONE.points(np.array([0.05, 0.07]), np.array([0.3, 1.3]))
    vectors = np.array([[1.0, -2.0], [0.5, 4.0]])
    where = np.zeros(2, np.int64)
    both = KERNEL.distribute(points, where, vectors)
    for i in range(2):
        index = KERNEL.distribute(points, where, vectors[:, i])
        assert both.taxel_forces[:, i] == pytest.approx(index.taxel_forces)
    assert both.taxel_forces.sum(axis=0) + both.off_skin == pytest.approx([1.5, 2.0])


def test_kernel_separates_limbs():
    points = np.concatenate((SKIN.points, SKIN.points))
    limb = np.repeat([0, 1], len(SKIN.points))
    kernel = ForceKernel(points, limb, 3)
    touch = CONE.points(0.05, 0.0)[None]
    for index in range(2):
        felt = kernel.distribute(touch, np.array([index]), np.array([3.0])).taxel_forces
        assert felt[limb == index].sum() == pytest.approx(3.0)
        assert not felt[limb != index].any()
    bare = kernel.distribute(touch, np.array([2]), np.array([3.0]))
    assert bare.off_skin == 3.0


def test_kernel_without_taxels_reports_all_force_off_skin():
    kernel = ForceKernel(np.empty((0, 3)), np.empty(0, np.int64), 1)
    share = kernel.distribute(np.zeros((1, 3)), np.zeros(1, np.int64), np.ones(1))
    assert share.off_skin == 1.0
    assert share.taxel_forces.shape == (0,)


@pytest.mark.parametrize(
    ("sigma", "active", "peak"), [(0.004, 10, 1.93), (0.005, 16, 1.17), (0.006, 22, 0.86)]
)
def test_kernel_on_dense_grid_matches_published_figures(sigma, active, peak):
    """363 taxels at 6.5 mm on radius 35 mm, 4.905 N: the published check of this kernel."""
    step = 0.0065
    x = np.arange(11) * step
    theta = np.arange(33) * step / 0.035
    places = np.stack(np.meshgrid(x, theta, indexing="ij"), axis=-1).reshape(-1, 2)
    grid = place_taxels(Cone(-0.01, 0.1, 0.035, 0.035), places)
    kernel = ForceKernel(grid.points, np.zeros(363, np.int64), 1, sigma)
    counts, peaks, errors = [], [], []
    rng = np.random.default_rng(0)
    for _ in range(200):
        spot = Cone(-0.01, 0.1, 0.035, 0.035).points(
            rng.uniform(0.02, 0.045), rng.uniform(1.0, 5.0)
        )
        felt = kernel.distribute(spot[None], np.zeros(1, np.int64), np.array([4.905])).taxel_forces
        assert felt.sum() == pytest.approx(4.905)
        counts.append(np.count_nonzero(felt))
        peaks.append(felt.max())
        errors.append(np.linalg.norm(felt @ grid.points / 4.905 - spot))
    assert np.mean(counts) == pytest.approx(active, rel=0.2)
    assert np.mean(peaks) == pytest.approx(peak, rel=0.25)
    assert np.median(errors) < 0.0006


def description() -> RobotDescription:
    limb = Limb("lower", "body", np.zeros(3), np.eye(3), CONE)
    patch = Patch(
        "p",
        "lower",
        tuple(SKIN.offset.tolist()),
        SKIN.points,
        SKIN.normals,
        Sensitivity(0.05, 2, 240),
    )
    return RobotDescription("r", (GenericPart("arm", (), limbs=(limb,), patches=(patch,)),))


def test_kernel_lists_contacts_per_touch():
    geometry = SkinGeometry.of(description(), version=3)
    assert (geometry.size, geometry.version, geometry.limbs) == (240, 3, ("arm/lower",))
    neighbours = TaxelGraph.of(geometry.points, geometry.limb)
    spots = CONE.points(np.array([0.05, 0.07]), np.array([0.2, 2.8]))
    force = KERNEL.distribute(spots, np.zeros(2, np.int64), np.array([2.0, 5.0])).taxel_forces
    shear = np.zeros((240, 3))
    shear[force > 0, 0] = 0.1
    listed = contacts(geometry, neighbours, force, shear)
    assert sorted(index.force for index in listed) == pytest.approx([2.0, 5.0])
    for index in listed:
        spot = spots[0] if index.force < 3 else spots[1]
        assert index.centre == pytest.approx(spot, abs=0.003)
        outward = spot - [spot[0], 0, 0]
        assert index.normal @ outward / np.linalg.norm(outward) > 0.95
        assert index.area == pytest.approx(len(index.taxels) * 36.6e-6, rel=0.01)
        assert index.shear[0] == pytest.approx(0.1 * len(index.taxels))
        assert index.pressure == pytest.approx(index.force / len(index.taxels))
    assert contacts(geometry, neighbours, np.zeros(240)) == []
    assert geometry.normaliser.force(np.full(240, 20.0)) == pytest.approx(np.full(240, 1.0))


def sensor(**settings_) -> Sensor:
    return Sensor(1000, Imperfections(**settings_), np.random.default_rng(5))


def test_tactile_sensor_without_errors_reads_force():
    force = np.linspace(0, 10, 1000)
    assert sensor().read(force) == pytest.approx(force)
    raw = sensor().raw(force, 0.02)
    assert raw[[0, 500, 999]].tolist() == [240, 240 - 100, 40]
    assert sensor().raw(np.full(1000, 100.0), 0.02).max() == 0


def test_tactile_sensor_applies_configured_errors():
    force = np.full(1000, 2.0)
    assert not sensor(threshold=2.5).read(force).any()
    assert (sensor(saturation=1.5).read(force) == 1.5).all()
    assert np.std(sensor(noise=0.1).read(force)) == pytest.approx(0.1, rel=0.1)
    dead = sensor(dead=0.2)
    assert np.mean(dead.read(force) == 0.0) == pytest.approx(0.2, abs=0.03)
    assert (dead.raw(force, 0.02)[dead.dead] == 240).all()
    drifting = sensor(drift=1.0)
    for _ in range(50 * 100):
        raw = drifting.raw(force, 0.02)
    assert np.std(raw.astype(float)) == pytest.approx(10, rel=0.2)
    assert (sensor(noise=0.1).read(force) == sensor(noise=0.1).read(force)).all()


@pytest.mark.parametrize("wrong", [{"threshold": 13}, {"dead": 1.5}, {"noise": -1}, {"drift": -1}])
def test_tactile_sensor_refuses_invalid_settings(wrong):
    with pytest.raises(ValueError, match=r"must|needed"):
        Imperfections(**wrong)

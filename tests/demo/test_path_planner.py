"""The finger's way around things, and where on the robot it meets skin."""

from itertools import pairwise

import numpy as np
import pytest

from robocomp_dsl.simulation.robots.catalog import ROBOTS
from tests.demo.touch_demo_samples import demo, part, places, recording, skin, world

path_planner = demo().path_planner


def ball(centre, radius):
    return lambda point: float(np.linalg.norm(point - np.array(centre)) - radius)


def sampled(points):
    return np.concatenate([np.linspace(a, b, 200) for a, b in pairwise(points)])


def test_path_planner_goes_straight_without_obstacles() -> None:
    goal = np.array([0.3, 0.0, 0.0])
    assert [
        p.tolist() for p in path_planner.plan_path(ball((0, 1, 0), 0.1), np.zeros(3), goal)
    ] == [[0.3, 0, 0]]


def test_path_planner_goes_around_obstacles() -> None:
    clear, start, goal = ball((0.2, 0, 0), 0.05), np.zeros(3), np.array([0.4, 0.0, 0.0])
    points = [start, *path_planner.plan_path(clear, start, goal)]
    assert len(points) > 2
    assert points[-1] is goal
    assert min(map(clear, sampled(points))) > 0.005


def test_path_planner_reaches_goal_near_obstacle_from_free_side() -> None:
    clear, start, goal = ball((0.2, 0, 0), 0.05), np.zeros(3), np.array([0.254, 0.0, 0.0])
    points = [start, *path_planner.plan_path(clear, start, goal)]
    assert min(map(clear, sampled(points))) > 0.003


def test_path_planner_reports_missing_path() -> None:
    def shell(point):
        return abs(float(np.linalg.norm(point)) - 0.1) - 0.02

    with pytest.raises(path_planner.NoPath, match="touches nothing else"):
        path_planner.plan_path(shell, np.zeros(3), np.array([0.5, 0.0, 0.0]))


@pytest.mark.parametrize("name", ["nao_h25", "icub_v2"])
def test_skin_map_places_are_first_contacts_of_finger(tmp_path, name) -> None:
    body = demo().body.Body(world(tmp_path, name), skin(name), part(name))
    body.pose(ROBOTS[name]().start, finger=np.zeros(3))
    home = body.finger_point
    assert home == pytest.approx([0.6, 0.6, 0.5])
    accessible = [place for place in places(name) if body.is_accessible(place)]
    assert len(accessible) >= 5
    for place in accessible:
        spot, out = body.touching(place), body.outward(place)
        assert body.clearance(spot) == pytest.approx(0.0, abs=1e-3), place.name
        assert body.clearance(spot + 0.01 * out) > 0.008, place.name
        assert np.linalg.norm(spot - body.centre(place)) < 0.012
        body.pose(finger=body.finger_joints(spot))
        assert body.finger_point == pytest.approx(spot)
        goal = spot + 0.035 * out
        points = [home, *path_planner.plan_path(body.clearance, home, goal)]
        assert min(map(body.clearance, sampled(points))) > 0.004, place.name
        body.pose(finger=np.zeros(3))


def test_skin_map_is_cut_where_nothing_is_pressed() -> None:
    seam, unrolled = demo().skin_map.seam, demo().skin_map.unrolled
    assert seam(places()[:4]) == pytest.approx(np.radians(-135))
    front = places()[4]
    (at,) = unrolled(front.centre[None], 0.03, seam([front]))
    assert at == pytest.approx([np.pi * 30, 32])  # in the middle, and 32 mm along the limb


def test_skin_map_field_edge_is_at_radius() -> None:
    it, place = recording(), places()[0]
    points = it.skin.points[it.skin.of(place.limb)]
    turns, along, away = demo().skin_map.outline(points, place, -np.pi)
    at = np.unravel_index(away.argmin(), away.shape)
    assert away.min() < 0.03
    assert turns[at[1]] == pytest.approx(np.pi, abs=0.02)
    assert along[at[0]] == pytest.approx(0.06, abs=1e-3)
    inside = along[(away < 1).any(axis=1)]
    assert (inside.min(), inside.max()) == pytest.approx((0.022, 0.098), abs=2e-3)

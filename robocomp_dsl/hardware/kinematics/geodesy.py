"""Positions on the globe: from metres around an origin to degrees, and to the UTM projection.

WGS 84. The tangent plane is good to a few cm over some km; UTM is Krüger's series to the third
order (Karney, Transverse Mercator with an accuracy of a few nanometers, 2011).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

_AXIS = 6378137.0  # m
_FLATTENING = 1 / 298.257223563
_SCALE = 0.9996
_EAST, _SOUTH = 500_000.0, 10_000_000.0  # m
_N = _FLATTENING / (2 - _FLATTENING)
_RECTIFYING = _AXIS / (1 + _N) * (1 + _N**2 / 4 + _N**4 / 64)
_ALPHA = (
    _N / 2 - 2 * _N**2 / 3 + 5 * _N**3 / 16,
    13 * _N**2 / 48 - 3 * _N**3 / 5,
    61 * _N**3 / 240,
)
_BANDS = "CDEFGHJKLMNPQRSTUVWXX"


@dataclass(frozen=True, slots=True)
class GeoPoint:
    """Latitude and longitude in degrees, altitude in m."""

    latitude: float
    longitude: float
    altitude: float


def offset(origin: GeoPoint, east: float, north: float, up: float) -> GeoPoint:
    """The position at an offset in m from `origin`."""
    phi = math.radians(origin.latitude)
    squared = _FLATTENING * (2 - _FLATTENING)
    bent = 1 - squared * math.sin(phi) ** 2
    along = _AXIS * (1 - squared) / bent**1.5
    across = _AXIS / math.sqrt(bent) * max(math.cos(phi), 1e-9)
    return GeoPoint(
        origin.latitude + math.degrees(north / along),
        origin.longitude + math.degrees(east / across),
        origin.altitude + up,
    )


def utm(place: GeoPoint) -> tuple[int, str, float, float]:
    """Zone, band, easting and northing in m."""
    zone = int((place.longitude + 180) // 6) % 60 + 1
    band = _BANDS[min(max(int((place.latitude + 80) // 8), 0), 20)]
    phi = math.radians(place.latitude)
    lam = math.radians(place.longitude - (6 * zone - 183))
    root = 2 * math.sqrt(_N) / (1 + _N)
    sine = math.sin(phi)
    tau = math.sinh(math.atanh(sine) - root * math.atanh(root * sine))
    xi = math.atan2(tau, math.cos(lam))
    eta = math.atanh(math.sin(lam) / math.hypot(1, tau))
    north, east = xi, eta
    for i, alpha in enumerate(_ALPHA, 1):
        north += alpha * math.sin(2 * i * xi) * math.cosh(2 * i * eta)
        east += alpha * math.cos(2 * i * xi) * math.sinh(2 * i * eta)
    south = _SOUTH if place.latitude < 0 else 0.0
    return zone, band, _EAST + _SCALE * _RECTIFYING * east, south + _SCALE * _RECTIFYING * north

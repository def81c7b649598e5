"""Certificates that `rcdeploy keys` would not make: expired ones, and of another authority."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta
from pathlib import Path

from robocomp_dsl.deploy.network.certificates import KeyPair, make_authority, make_certificate
from robocomp_dsl.deploy.network.key_folder import AUTHORITY, KeyFolder, write_private
from robocomp_dsl.runtime.presence.network_settings import NetworkSettings

DAY = timedelta(days=1)


def now() -> datetime:
    return datetime.now(UTC)


def authority_of(keys: KeyFolder) -> KeyPair:
    """The certificate authority in a folder."""
    return KeyPair(keys.certificate(AUTHORITY).read_bytes(), keys.key(AUTHORITY).read_bytes())


def foreign_authority() -> KeyPair:
    """An authority of the same name that nobody trusts."""
    return make_authority("site", now() - DAY, now() + DAY)


def write_pair(pair: KeyPair, folder: Path, name: str) -> tuple[Path, Path]:
    """The files of a certificate and its key."""
    folder.mkdir(exist_ok=True)
    certificate, key = folder / f"{name}.pem", folder / f"{name}.key"
    write_private(certificate, pair.certificate)
    write_private(key, pair.key)
    return certificate, key


def settings_with(
    keys: KeyFolder,
    folder: Path,
    endpoints: tuple[str, ...],
    name: str = "boss",
    authority: KeyPair | None = None,
    begin: timedelta = -DAY,
    end: timedelta = DAY,
) -> NetworkSettings:
    """Settings with a certificate that is valid from `begin` to `end` from now."""
    pair = make_certificate(authority or authority_of(keys), name, (), now() + begin, now() + end)
    certificate, key = write_pair(pair, folder, "made")
    return NetworkSettings(endpoints, keys.certificate(AUTHORITY), certificate, key)

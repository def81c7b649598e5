"""Makes the keys of a deployment: what is missing, what ends soon, or all of them.

In: identities, a folder, the time. Out: files, and a `KeyChange` for each identity.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from datetime import datetime, timedelta

from robocomp_dsl.deploy.network.certificates import (
    CertificateFacts,
    KeyPair,
    UnusableKey,
    check_key,
    is_signed_by,
    make_authority,
    make_certificate,
    read_certificate,
)
from robocomp_dsl.deploy.network.identities import Identity
from robocomp_dsl.deploy.network.key_folder import AUTHORITY, KeyFolder
from robocomp_dsl.record import ValueRecord

DAYS = 90
"""Default life of a certificate."""
AUTHORITY_DAYS = 3650
_CLOCK_TOLERANCE = timedelta(hours=1)
"""Certificates begin so much earlier: the clock of a host may be slow."""

KEPT, NEW, RENEWED = "valid", "new", "renewed"


class KeyChange(ValueRecord):
    """What was done for one identity, and why: `action` is `KEPT`, `NEW` or `RENEWED`."""

    name: str
    kind: str
    action: str
    reason: str
    facts: CertificateFacts


def update_keys(
    deployment: str,
    required: Iterable[Identity],
    folder: KeyFolder,
    now: datetime,
    *,
    days: float = DAYS,
    renew: bool = False,
) -> list[KeyChange]:
    """Make what is missing, and renew what ends within a third of its life; with `renew`, all.

    With `renew` there is also a new authority: what has a certificate of the old one is refused
    from then on. Raises `UnsafeKeys` or `UnusableKey`.
    """
    folder.create()
    changes = [_update_authority(deployment, folder, now, renew=renew)]
    authority = KeyPair(
        folder.certificate(AUTHORITY).read_bytes(), folder.key(AUTHORITY).read_bytes()
    )
    # No certificate is valid for longer than its authority.
    end = min(now + timedelta(days=days), changes[0].facts.end)
    for identity in required:
        reason = outdated_reason(identity, folder, now)
        if reason:
            existed = folder.certificate(identity.name).exists()
            begin = now - _CLOCK_TOLERANCE
            pair = make_certificate(authority, identity.name, identity.addresses, begin, end)
            folder.write(identity.name, pair.certificate, pair.key)
        action = KEPT if not reason else RENEWED if existed else NEW
        facts = read_certificate(folder.certificate(identity.name))
        changes.append(KeyChange(identity.name, identity.kind, action, reason, facts))
    return changes


def _update_authority(
    deployment: str, folder: KeyFolder, now: datetime, *, renew: bool
) -> KeyChange:
    existed = folder.has(AUTHORITY)
    reason = "" if existed else "it was missing"
    if existed and renew:
        reason = "--renew"
    elif existed:
        check_key(folder.certificate(AUTHORITY), folder.key(AUTHORITY))
        if read_certificate(folder.certificate(AUTHORITY)).end <= now:
            reason = "it had expired"
    if reason:
        end = now + timedelta(days=AUTHORITY_DAYS)
        pair = make_authority(deployment, now - _CLOCK_TOLERANCE, end)
        folder.write(AUTHORITY, pair.certificate, pair.key)
    action = KEPT if not reason else RENEWED if existed else NEW
    facts = read_certificate(folder.certificate(AUTHORITY))
    return KeyChange(AUTHORITY, "authority", action, reason, facts)


def outdated_reason(identity: Identity, folder: KeyFolder, now: datetime) -> str:
    """Why an identity needs a new certificate; empty: it does not."""
    if not folder.has(identity.name):
        return "it was missing"
    try:
        return next(_reasons(identity, folder, now), "")
    except UnusableKey as error:
        return str(error)


def _reasons(identity: Identity, folder: KeyFolder, now: datetime) -> Iterator[str]:
    certificate = folder.certificate(identity.name)
    check_key(certificate, folder.key(identity.name))
    facts = read_certificate(certificate)
    if not is_signed_by(certificate, folder.certificate(AUTHORITY)):
        yield "another authority had signed it"
    if set(facts.addresses) != set(identity.addresses) or facts.name != identity.name:
        yield "it was for another address or name"
    if facts.end <= now:
        yield "it had expired"
    if facts.begin > now:
        yield "it was not valid yet"
    if facts.ends_soon(now):
        yield "less than a third of its life was left"

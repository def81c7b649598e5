"""Keys of a deployment: made, renewed, shown; who can read them, and where they never appear."""

from __future__ import annotations

import json
import re
import stat
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest

from robocomp_dsl.deploy.network import codes
from robocomp_dsl.deploy.network.certificates import (
    UnusableKey,
    is_signed_by,
    make_certificate,
    read_certificate,
)
from robocomp_dsl.deploy.network.identities import Identity
from robocomp_dsl.deploy.network.key_checks import check_keys
from robocomp_dsl.deploy.network.key_folder import AUTHORITY, KeyFolder, UnsafeKeys, key_folder
from robocomp_dsl.deploy.network.update_keys import KEPT, NEW, RENEWED, KeyChange, update_keys
from robocomp_dsl.diagnostics import Report
from tests.deploy.network.made_certificates import authority_of, foreign_authority, write_pair
from tests.deploy.network.secured_deployment import SecuredDeployment
from tests.deploy.rcdeploy_process import rcdeploy

NOW = datetime(2026, 11, 23, 12, tzinfo=UTC)
DAY = timedelta(days=1)
WANTED = (
    Identity("left/arm", "component"),
    Identity("router.robot", "router", ("10.0.0.2", "127.0.0.1", "localhost")),
    Identity("rcdeploy", "operator"),
)


@pytest.fixture
def folder(tmp_path: Path) -> KeyFolder:
    return KeyFolder(tmp_path / "keys")


def update(
    folder: KeyFolder, *, after: timedelta = timedelta(), renew: bool = False, days: float = 90
) -> dict[str, KeyChange]:
    changes = update_keys("site", WANTED, folder, NOW + after, renew=renew, days=days)
    return {change.name: change for change in changes}


def contents(folder: KeyFolder) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in folder.path.iterdir()}


def test_update_keys_makes_authority_and_certificates(folder: KeyFolder) -> None:
    changes = update(folder)
    assert {change.action for change in changes.values()} == {NEW}
    authority, arm = changes[AUTHORITY].facts, changes["left/arm"].facts
    assert authority.end == NOW + 3650 * DAY
    assert (arm.name, arm.addresses, arm.end) == ("left/arm", (), NOW + 90 * DAY)
    assert changes["router.robot"].facts.addresses == WANTED[1].addresses
    for name in ("left/arm", "router.robot", "rcdeploy"):
        assert is_signed_by(folder.certificate(name), folder.certificate(AUTHORITY))
    assert sorted(contents(folder)) == sorted(
        f"{name}.{kind}"
        for name in ("ca", "left%2Farm", "router.robot", "rcdeploy")
        for kind in ("pem", "key")
    )


def test_update_keys_lets_nobody_else_read_them(folder: KeyFolder) -> None:
    update(folder)
    assert stat.S_IMODE(folder.path.stat().st_mode) == 0o700
    modes = {stat.S_IMODE(path.stat().st_mode) for path in folder.path.iterdir()}
    assert modes == {0o600}


def test_update_keys_again_changes_nothing(folder: KeyFolder) -> None:
    update(folder)
    before = contents(folder)
    changes = update(folder, after=59 * DAY)
    assert {change.action for change in changes.values()} == {KEPT}
    assert contents(folder) == before


def test_update_keys_adds_what_is_missing_only(folder: KeyFolder) -> None:
    update(folder)
    before = contents(folder)
    folder.key("rcdeploy").unlink()
    changes = update(folder, after=DAY)
    assert {name for name, change in changes.items() if change.action != KEPT} == {"rcdeploy"}
    changed = {name for name, data in contents(folder).items() if before.get(name) != data}
    assert changed == {"rcdeploy.pem", "rcdeploy.key"}


def test_update_keys_renews_what_ends_within_a_third_of_its_life(folder: KeyFolder) -> None:
    update(folder)
    changes = update(folder, after=61 * DAY)
    assert changes[AUTHORITY].action == KEPT
    assert changes["left/arm"].action == RENEWED
    assert changes["left/arm"].reason == "less than a third of its life was left"
    assert changes["left/arm"].facts.end == NOW + 151 * DAY


def test_update_keys_with_renew_makes_new_authority(folder: KeyFolder, tmp_path: Path) -> None:
    update(folder)
    old = tmp_path / "old.pem"
    old.write_bytes(folder.certificate(AUTHORITY).read_bytes())
    changes = update(folder, renew=True, days=2)
    assert {change.action for change in changes.values()} == {RENEWED}
    assert changes["left/arm"].facts.end == NOW + 2 * DAY
    assert not is_signed_by(folder.certificate("left/arm"), old)


def test_update_keys_replaces_expired_authority_and_its_certificates(folder: KeyFolder) -> None:
    update(folder)
    changes = update(folder, after=3651 * DAY)
    assert changes[AUTHORITY].reason == "it had expired"
    assert {change.action for change in changes.values()} == {RENEWED}
    assert is_signed_by(folder.certificate("left/arm"), folder.certificate(AUTHORITY))


def test_no_certificate_is_valid_for_longer_than_its_authority(folder: KeyFolder) -> None:
    update(folder)
    changes = update(folder, after=3640 * DAY)
    assert changes["left/arm"].facts.end == changes[AUTHORITY].facts.end


def test_update_keys_makes_new_certificate_for_changed_address(folder: KeyFolder) -> None:
    update(folder)
    router = Identity("router.robot", "router", ("10.0.0.9", "127.0.0.1", "localhost"))
    changes = update_keys("site", [router], folder, NOW)
    assert changes[1].reason == "it was for another address or name"
    assert "10.0.0.9" in changes[1].facts.addresses


def test_update_keys_replaces_damaged_files_but_not_the_authority(folder: KeyFolder) -> None:
    update(folder)
    folder.certificate("rcdeploy").write_bytes(b"damaged")
    folder.key("left/arm").write_bytes(folder.key("rcdeploy").read_bytes())
    changes = update(folder)
    assert "is no certificate" in changes["rcdeploy"].reason
    assert "does not belong to the certificate" in changes["left/arm"].reason
    folder.key(AUTHORITY).write_bytes(b"damaged")
    with pytest.raises(UnusableKey, match=r"ca\.key is no private key"):
        update(folder)


def test_update_keys_refuses_folder_that_others_can_read(folder: KeyFolder) -> None:
    update(folder)
    folder.path.chmod(0o755)
    with pytest.raises(UnsafeKeys, match="run `chmod 700"):
        update(folder)
    folder.path.chmod(0o700)
    folder.key("rcdeploy").chmod(0o644)
    with pytest.raises(UnsafeKeys, match=r"rcdeploy\.key \(mode 644\): run `chmod 600"):
        update(folder)


def found_codes(site: SecuredDeployment, at: datetime) -> list[tuple[str, str]]:
    report = Report()
    check_keys(site.deployment, site.keys, at, report)
    return [(each.code.id, each.message) for each in report.sorted()]


@pytest.fixture
def at(site: SecuredDeployment) -> datetime:
    """Now: the keys of `site` are valid."""
    now = datetime.now(UTC)
    assert found_codes(site, now) == []
    return now


def test_check_keys_finds_missing_keys(site: SecuredDeployment, at: datetime) -> None:
    site.keys.key("worker").unlink()
    assert found_codes(site, at) == [
        (codes.KEYS_MISSING.id, "there is no certificate for worker"),
    ]
    site.keys.key(AUTHORITY).unlink()
    assert found_codes(site, at) == [
        (codes.KEYS_MISSING.id, "`site` is on several hosts and has no keys"),
    ]


def test_check_keys_finds_dates_and_clocks(site: SecuredDeployment, at: datetime) -> None:
    assert {code for code, _ in found_codes(site, at + 61 * DAY)} == {
        codes.CERTIFICATE_ENDS_SOON.id
    }
    assert {code for code, _ in found_codes(site, at + 91 * DAY)} == {codes.CERTIFICATE_EXPIRED.id}
    ((code, message),) = found_codes(site, at + 3651 * DAY)
    assert code == codes.AUTHORITY_EXPIRED.id
    assert "the certificate authority (CA) expired" in message
    ((code, message),) = found_codes(site, at - DAY)
    assert code == codes.CERTIFICATE_NOT_YET_VALID.id
    assert "by the clock of this machine" in message


def test_check_keys_finds_certificate_of_the_future(site: SecuredDeployment, at: datetime) -> None:
    pair = make_certificate(authority_of(site.keys), "worker", (), at + DAY, at + 9 * DAY)
    write_pair(pair, site.keys.path, "worker")
    ((code, message),) = found_codes(site, at)
    assert code == codes.CERTIFICATE_NOT_YET_VALID.id
    assert message.startswith("the certificate of worker is valid from ")


def test_check_keys_finds_foreign_authority(site: SecuredDeployment, at: datetime) -> None:
    pair = make_certificate(foreign_authority(), "worker", (), at - DAY, at + 9 * DAY)
    write_pair(pair, site.keys.path, "worker")
    assert found_codes(site, at) == [
        (
            codes.FOREIGN_AUTHORITY.id,
            "another certificate authority (CA) signed the certificate of worker",
        )
    ]


def test_check_keys_finds_key_that_others_can_read(site: SecuredDeployment, at: datetime) -> None:
    site.keys.key("boss").chmod(0o660)
    ((code, message),) = found_codes(site, at)
    assert code == codes.KEY_READABLE.id
    assert message.endswith("boss.key (mode 660)")


def test_check_keys_finds_unusable_files(site: SecuredDeployment, at: datetime) -> None:
    site.keys.certificate("boss").write_text("damaged")
    ((code, message),) = found_codes(site, at)
    assert code == codes.KEY_UNUSABLE.id
    assert message.endswith("boss.pem is no certificate")


def test_check_keys_finds_certificate_for_another_address(
    site: SecuredDeployment, at: datetime
) -> None:
    pair = make_certificate(
        authority_of(site.keys), "router.left", ("10.0.0.9",), at - DAY, at + 9 * DAY
    )
    write_pair(pair, site.keys.path, "router.left")
    ((code, message),) = found_codes(site, at)
    assert code == codes.CERTIFICATE_OUTDATED.id
    assert "is for 10.0.0.9, and the host has the address 127.0.0.2" in message


def test_rcdeploy_keys_makes_and_shows_keys(
    components: Path, private_home: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    app = SecuredDeployment(components).deployment.path
    folder = key_folder("site")
    for path in folder.path.iterdir():
        path.unlink()
    missing = rcdeploy("keys", str(app), "--show")
    assert missing.returncode == 1
    assert "RC850" in missing.stderr
    first = rcdeploy("keys", str(app), "--days", "30")
    assert first.returncode == 0, first.stderr
    assert re.search(r"worker +component +\S+, in (29|30) days +[0-9a-f]{16} +new", first.stdout)
    shown = rcdeploy("keys", str(app), "--show", "--format", "json")
    names = [entry["name"] for entry in json.loads(shown.stdout)]
    assert names == ["ca", "worker", "boss", "router.left", "router.right", "rcdeploy"]
    fingerprint = read_certificate(folder.certificate("worker")).fingerprint
    assert {e["fingerprint"] for e in json.loads(shown.stdout)} >= {fingerprint}
    folder.path.chmod(0o777)
    refused = rcdeploy("keys", str(app))
    assert refused.returncode == 1
    assert "run `chmod 700" in refused.stderr


def test_rcdeploy_keys_needs_none_on_one_machine(components: Path, private_home: Path) -> None:
    app = components / "local.ddsl"
    app.write_text(
        'import "boss/boss.cdsl"; import "worker/worker.cdsl";'
        " Deployment local { component worker; component boss; };"
    )
    done = rcdeploy("keys", str(app))
    assert done.returncode == 0
    assert "need no keys" in done.stdout
    assert not key_folder("local").path.exists()


def test_rcdeploy_plan_access_shows_rules(site: SecuredDeployment) -> None:
    shown = rcdeploy("plan", "--access", str(site.deployment.path))
    assert "   calls Tasks::Job (queries and commands) of worker.Job as Job" in shown.stdout


def test_secrets_are_in_no_generated_text(site: SecuredDeployment) -> None:
    """Settings, rules, plans and messages name files with keys; none contains a key."""
    secrets = [
        line
        for path in site.keys.path.glob("*.key")
        for line in path.read_text().splitlines()
        if not line.startswith("-----")
    ]
    assert len(secrets) >= 6
    app = str(site.deployment.path)
    texts = [path.read_text() for path in site.keys.path.glob("*.json")]
    texts += [path.read_text() for path in (site.keys.path.parents[3] / "state").rglob("*.json")]
    for arguments in (("keys", app), ("keys", app, "--show"), ("plan", app, "--access")):
        done = rcdeploy(*arguments)
        texts += [done.stdout, done.stderr]
    assert len(texts) >= 9
    assert not any(secret in text for secret in secrets for text in texts)

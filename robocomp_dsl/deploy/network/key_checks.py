"""Checks the keys of a deployment before anything starts.

In: a deployment and a folder. Out: findings. Nothing is changed.
"""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

from robocomp_dsl.deploy.network import codes
from robocomp_dsl.deploy.network.certificates import (
    CertificateFacts,
    UnusableKey,
    check_key,
    is_signed_by,
    read_certificate,
)
from robocomp_dsl.deploy.network.identities import OPERATOR, Identity, identities, needs_network
from robocomp_dsl.deploy.network.key_folder import AUTHORITY, KeyFolder, UnsafeKeys
from robocomp_dsl.diagnostics import Code, Report
from robocomp_dsl.model.deployment import Deployment


def check_keys(deployment: Deployment, folder: KeyFolder, now: datetime, report: Report) -> None:
    """Report what is wrong with the keys; a deployment on this machine only needs none."""
    if not needs_network(deployment):
        return
    for instance in deployment.instances:
        if instance.full_name == OPERATOR:
            report.add(
                codes.RESERVED_NAME,
                instance.span,
                f"`{OPERATOR}` is the name of the operator's certificate",
                help="give the component another name, or a prefix",
            )
    _KeyCheck(deployment, folder, now, report).run()


class _KeyCheck:
    """One check; its findings are at the name of the deployment."""

    def __init__(
        self, deployment: Deployment, folder: KeyFolder, now: datetime, report: Report
    ) -> None:
        self._deployment = deployment
        self._command = f"run `rcdeploy keys {deployment.path.name}`"
        self._folder = folder
        self._now = now
        self._report = report

    def _add(self, code: Code, message: str, help_: str) -> None:
        self._report.add(code, self._deployment.span, message, help=help_)

    def run(self) -> None:
        """Check the folder, then the authority, then each certificate."""
        folder, all_identities = self._folder, identities(self._deployment)
        if not folder.has(AUTHORITY):
            message = f"`{self._deployment.name}` is on several hosts and has no keys"
            self._add(codes.KEYS_MISSING, message, self._command)
            return
        try:
            folder.check()
        except UnsafeKeys as error:
            text, _, remedy = str(error).partition(": run ")
            self._add(codes.KEY_READABLE, text, f"run {remedy}" if remedy else "see the folder")
            return
        if not self._check_authority():
            return
        missing = [each.name for each in all_identities if not folder.has(each.name)]
        if missing:
            message = f"there is no certificate for {', '.join(missing)}"
            self._add(codes.KEYS_MISSING, message, self._command)
        present = [identity for identity in all_identities if identity.name not in missing]
        if soon := [identity.name for identity in present if self._check(identity)]:
            message = f"the certificate of {', '.join(soon)} ends soon"
            self._add(codes.CERTIFICATE_ENDS_SOON, message, self._command)

    def _read(self, name: str) -> CertificateFacts | None:
        certificate: Path = self._folder.certificate(name)
        try:
            check_key(certificate, self._folder.key(name))
            return read_certificate(certificate)
        except UnusableKey as error:
            files = f"{certificate} and {self._folder.key(name)}"
            self._add(codes.KEY_UNUSABLE, str(error), f"delete {files}, then {self._command}")
            return None

    def _check_authority(self) -> bool:
        facts = self._read(AUTHORITY)
        if facts is None:
            return False
        renew = f"{self._command} --renew"
        if facts.end <= self._now:
            message = f"the certificate authority (CA) expired at {facts.end:%Y-%m-%d}"
            self._add(codes.AUTHORITY_EXPIRED, message, renew)
        elif facts.begin > self._now:
            self._add_not_yet_valid("certificate authority (CA)", facts)
        else:
            return True
        return False

    def _add_not_yet_valid(self, what: str, facts: CertificateFacts) -> None:
        self._add(
            codes.CERTIFICATE_NOT_YET_VALID,
            f"the {what} is valid from {facts.begin:%Y-%m-%d %H:%M} UTC, and it is"
            f" {self._now:%Y-%m-%d %H:%M} UTC by the clock of this machine",
            "set the clock of this machine (`timedatectl set-ntp true`)",
        )

    def _check(self, identity: Identity) -> bool:
        """Check a certificate; returns whether it is valid and ends soon."""
        facts = self._read(identity.name)
        if facts is None:
            return False
        what = f"certificate of {identity.name}"
        if not is_signed_by(
            self._folder.certificate(identity.name), self._folder.certificate(AUTHORITY)
        ):
            message = f"another certificate authority (CA) signed the {what}"
            self._add(codes.FOREIGN_AUTHORITY, message, self._command)
        elif facts.end <= self._now:
            message = f"the {what} expired at {facts.end:%Y-%m-%d %H:%M} UTC"
            self._add(codes.CERTIFICATE_EXPIRED, message, self._command)
        elif facts.begin > self._now:
            self._add_not_yet_valid(what, facts)
        elif set(facts.addresses) != set(identity.addresses):
            message = (
                f"the {what} is for {', '.join(facts.addresses)}, and the host has the address"
                f" {', '.join(identity.addresses)}"
            )
            self._add(codes.CERTIFICATE_OUTDATED, message, self._command)
        else:
            return facts.ends_soon(self._now)
        return False

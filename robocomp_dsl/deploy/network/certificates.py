"""Certificates and keys: made, and read back. The only module that uses `cryptography`.

In: names, addresses, dates. Out: PEM, or what a certificate says. Keys are on the curve P-256,
which zenoh's TLS and that of Python accept.
"""

from __future__ import annotations

from dataclasses import dataclass
from datetime import datetime
from ipaddress import ip_address
from pathlib import Path

from cryptography import x509
from cryptography.exceptions import InvalidSignature
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID

from robocomp_dsl.deploy.network.identities import is_ip_address


class UnusableKey(Exception):
    """A file that is no certificate or key, or one that does not belong to the other."""


@dataclass(frozen=True, slots=True)
class KeyPair:
    """A certificate and its private key, in PEM."""

    certificate: bytes
    key: bytes


@dataclass(frozen=True, slots=True)
class CertificateFacts:
    """What a certificate says. `fingerprint` is the SHA-256 of it, in hexadecimal."""

    name: str
    addresses: tuple[str, ...]
    begin: datetime
    end: datetime
    fingerprint: str

    def ends_soon(self, now: datetime) -> bool:
        """Whether less than a third of its life is left."""
        return self.end - now < (self.end - self.begin) / 3


def make_authority(deployment: str, begin: datetime, end: datetime) -> KeyPair:
    """A certificate authority with a key of its own."""
    key = ec.generate_private_key(ec.SECP256R1())
    name = _name(f"CA of the deployment {deployment}"[:64])
    builder = (
        _builder(name, name, key, begin, end)
        .add_extension(x509.BasicConstraints(ca=True, path_length=0), critical=True)
        .add_extension(_key_usage(signs=True), critical=True)
        .add_extension(x509.SubjectKeyIdentifier.from_public_key(key.public_key()), critical=False)
    )
    return _pair(builder.sign(key, hashes.SHA256()), key)


def make_certificate(
    authority: KeyPair, name: str, addresses: tuple[str, ...], begin: datetime, end: datetime
) -> KeyPair:
    """A certificate with a new key, signed by `authority`; with `addresses`, that of a server.

    Raises `UnusableKey`.
    """
    issuer = _certificate(authority.certificate)
    issuer_key = _key(authority.key)
    key = ec.generate_private_key(ec.SECP256R1())
    usages = [ExtendedKeyUsageOID.CLIENT_AUTH]
    if addresses:
        usages.append(ExtendedKeyUsageOID.SERVER_AUTH)
    builder = (
        _builder(_name(name), issuer.subject, key, begin, end)
        .add_extension(x509.BasicConstraints(ca=False, path_length=None), critical=True)
        .add_extension(_key_usage(signs=False), critical=True)
        .add_extension(x509.ExtendedKeyUsage(usages), critical=False)
        .add_extension(
            x509.AuthorityKeyIdentifier.from_issuer_public_key(issuer.public_key()),  # type: ignore[arg-type]
            critical=False,
        )
    )
    if addresses:
        names = x509.SubjectAlternativeName(map(_general_name, addresses))
        builder = builder.add_extension(names, critical=False)
    return _pair(builder.sign(issuer_key, hashes.SHA256()), key)


def read_certificate(path: Path) -> CertificateFacts:
    """What the certificate in a file says. Raises `UnusableKey`."""
    return certificate_facts(_read(path), str(path))


def certificate_facts(pem: bytes, place: str) -> CertificateFacts:
    """What a certificate says; `place` is for the message. Raises `UnusableKey`."""
    certificate = _certificate(pem, place)
    try:
        extension = certificate.extensions.get_extension_for_class(x509.SubjectAlternativeName)
        addresses = tuple(str(entry.value) for entry in extension.value)
    except x509.ExtensionNotFound:
        addresses = ()
    names = certificate.subject.get_attributes_for_oid(NameOID.COMMON_NAME)
    return CertificateFacts(
        str(names[0].value) if names else "",
        addresses,
        certificate.not_valid_before_utc,
        certificate.not_valid_after_utc,
        certificate.fingerprint(hashes.SHA256()).hex(),
    )


def is_signed_by(certificate: Path, authority: Path) -> bool:
    """Whether the authority in a file signed the certificate in the other. Raises `UnusableKey`."""
    try:
        _certificate(_read(certificate), str(certificate)).verify_directly_issued_by(
            _certificate(_read(authority), str(authority))
        )
    except (ValueError, TypeError, InvalidSignature):
        return False
    return True


def check_key(certificate: Path, key: Path) -> None:
    """Raise `UnusableKey` if the key does not belong to the certificate."""
    public = _certificate(_read(certificate), str(certificate)).public_key()
    if _key(_read(key), str(key)).public_key() != public:
        raise UnusableKey(f"the key {key} does not belong to the certificate {certificate}")


def _read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as error:
        raise UnusableKey(f"{path} cannot be read: {error.strerror or error}") from None


def _certificate(pem: bytes, place: str = "the certificate") -> x509.Certificate:
    try:
        return x509.load_pem_x509_certificate(pem)
    except ValueError:
        raise UnusableKey(f"{place} is no certificate") from None


def _key(pem: bytes, place: str = "the key") -> ec.EllipticCurvePrivateKey:
    try:
        key = serialization.load_pem_private_key(pem, password=None)
    except (ValueError, TypeError):
        key = None
    if not isinstance(key, ec.EllipticCurvePrivateKey):
        raise UnusableKey(f"{place} is no private key that `rcdeploy keys` made")
    return key


def _builder(
    subject: x509.Name,
    issuer: x509.Name,
    key: ec.EllipticCurvePrivateKey,
    begin: datetime,
    end: datetime,
) -> x509.CertificateBuilder:
    return (
        x509.CertificateBuilder()
        .subject_name(subject)
        .issuer_name(issuer)
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(begin)
        .not_valid_after(end)
    )


def _key_usage(*, signs: bool) -> x509.KeyUsage:
    """An authority signs certificates; others sign handshakes."""
    return x509.KeyUsage(
        digital_signature=not signs,
        content_commitment=False,
        key_encipherment=False,
        data_encipherment=False,
        key_agreement=False,
        key_cert_sign=signs,
        crl_sign=signs,
        encipher_only=False,
        decipher_only=False,
    )


def _name(common_name: str) -> x509.Name:
    return x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, common_name)])


def _general_name(address: str) -> x509.GeneralName:
    if is_ip_address(address):
        return x509.IPAddress(ip_address(address))
    return x509.DNSName(address)


def _pair(certificate: x509.Certificate, key: ec.EllipticCurvePrivateKey) -> KeyPair:
    return KeyPair(
        certificate.public_bytes(serialization.Encoding.PEM),
        key.private_bytes(
            serialization.Encoding.PEM,
            serialization.PrivateFormat.PKCS8,
            serialization.NoEncryption(),
        ),
    )

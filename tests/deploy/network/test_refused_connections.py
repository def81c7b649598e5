"""Programs that a router does not let in, and what they and the router say about it."""

from __future__ import annotations

import socket
import ssl
from collections.abc import Iterator
from pathlib import Path

import pytest

from robocomp_dsl.deploy.network.certificates import make_certificate
from robocomp_dsl.deploy.network.key_folder import AUTHORITY
from robocomp_dsl.deploy.network.router_plan import operator_endpoints
from robocomp_dsl.runtime.errors import MiddlewareError
from robocomp_dsl.runtime.presence.client_session import open_client_session
from robocomp_dsl.runtime.presence.connection_failure import explain_failure
from robocomp_dsl.runtime.presence.network_settings import (
    InvalidNetwork,
    NetworkSettings,
    read_network_settings,
)
from tests.deploy.network.made_certificates import (
    DAY,
    authority_of,
    foreign_authority,
    now,
    settings_with,
    write_pair,
)
from tests.deploy.network.secured_deployment import SecuredDeployment, free_ports
from tests.deploy.rcdeploy_process import RunningProcess, runtime_folder

Running = tuple[SecuredDeployment, RunningProcess]
TIMEOUT_S = 0.3
"""A refused connection is not accepted later."""


@pytest.fixture(scope="module")
def running(components: Path, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Running]:
    """The deployment with the router of `left`."""
    folder = tmp_path_factory.mktemp("home")
    with pytest.MonkeyPatch.context() as patch, runtime_folder(patch):
        patch.setenv("XDG_CONFIG_HOME", str(folder / "config"))
        patch.setenv("XDG_STATE_HOME", str(folder / "state"))
        site = SecuredDeployment(components)
        with site.start_router(site.hosts[0]) as router:
            yield site, router


def endpoints(site: SecuredDeployment) -> tuple[str, ...]:
    """That of the router which runs."""
    return operator_endpoints(site.deployment)[:1]


def refusal(settings: NetworkSettings) -> str:
    """Why the settings do not lead to a session."""
    with pytest.raises(MiddlewareError) as caught:
        open_client_session(settings, TIMEOUT_S).close()  # type: ignore[no-untyped-call]
    return str(caught.value)


def test_client_session_opens_with_valid_certificate(running: Running, tmp_path: Path) -> None:
    site, router = running
    settings = settings_with(site.keys, tmp_path, endpoints(site))
    open_client_session(settings).close()  # type: ignore[no-untyped-call]
    router.until("boss is connected")


def test_client_session_with_foreign_authority_is_refused(running: Running, tmp_path: Path) -> None:
    site, router = running
    settings = settings_with(site.keys, tmp_path, endpoints(site), authority=foreign_authority())
    text = refusal(settings)
    assert "it refuses the certificate of this program: another authority (CA)" in text
    router.until("refused a connection: invalid peer certificate")


def test_client_session_with_expired_certificate_is_refused(
    running: Running, tmp_path: Path
) -> None:
    site, router = running
    settings = settings_with(site.keys, tmp_path, endpoints(site), begin=-2 * DAY, end=-DAY)
    text = refusal(settings)
    assert "made.pem expired at " in text
    assert "rcdeploy keys APP.ddsl" in text
    router.until("refused a connection: invalid peer certificate: certificate expired")


def test_client_session_with_certificate_of_the_future_is_refused(
    running: Running, tmp_path: Path
) -> None:
    site, router = running
    settings = settings_with(site.keys, tmp_path, endpoints(site), begin=DAY, end=2 * DAY)
    text = refusal(settings)
    assert "made.pem is not valid before" in text
    assert "set the clock" in text
    router.until("refused a connection: invalid peer certificate: certificate not valid yet")


def test_router_refuses_connection_without_certificate(running: Running) -> None:
    site, router = running
    context = ssl.create_default_context(cafile=str(site.keys.certificate(AUTHORITY)))
    place = ("127.0.0.1", site.hosts[0].port)
    with (
        socket.create_connection(place) as opened,
        context.wrap_socket(opened, server_hostname="localhost") as link,
        pytest.raises(ssl.SSLError, match="CERTIFICATE_REQUIRED"),
    ):
        link.recv(1)
    router.until("refused a connection: peer sent no certificates")


def test_router_refuses_connection_without_tls(running: Running) -> None:
    site, router = running
    with socket.create_connection(("127.0.0.1", site.hosts[0].port)) as plain:
        plain.sendall(b"GET / HTTP/1.0\r\n\r\n")
        while plain.recv(100):
            pass
    router.until("refused a connection: received corrupt message")


def test_client_session_refuses_router_of_foreign_authority(
    running: Running, tmp_path: Path
) -> None:
    site, _ = running
    own = settings_with(site.keys, tmp_path, endpoints(site))
    foreign, _ = write_pair(foreign_authority(), tmp_path, "foreign")
    text = refusal(NetworkSettings(own.endpoints, foreign, own.certificate, own.key))
    assert "the router has a certificate of another authority (CA)" in text


def test_client_session_refuses_router_at_another_address(running: Running, tmp_path: Path) -> None:
    """The certificate of the router lists the addresses at which it may be reached."""
    site, _ = running
    settings = settings_with(site.keys, tmp_path, (f"tls/127.0.0.9:{free_ports(1)[0]}",))
    assert "no router listens there" in refusal(settings)
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    pair = make_certificate(
        authority_of(site.keys), "router.left", ("127.0.0.2",), now() - DAY, now() + DAY
    )
    context.load_cert_chain(*write_pair(pair, tmp_path / "server", "router"))
    with socket.create_server(("127.0.0.1", 0)) as server:
        settings = settings_with(site.keys, tmp_path, (f"tls/127.0.0.1:{server.getsockname()[1]}",))
        accepted: list[socket.socket] = []

        def accept() -> None:
            opened, _ = server.accept()
            accepted.append(opened)
            with pytest.raises(ssl.SSLError):
                context.wrap_socket(opened, server_side=True)

        import threading  # noqa: PLC0415

        thread = threading.Thread(target=accept)
        thread.start()
        text = explain_failure(settings, "Timeout!")
        thread.join()
        for opened in accepted:
            opened.close()
    assert "the certificate of the router is for another address" in text


def test_explain_failure_names_unknown_host_and_closed_port(
    running: Running, tmp_path: Path
) -> None:
    site, _ = running
    closed = f"tls/127.0.0.1:{free_ports(1)[0]}"
    settings = settings_with(site.keys, tmp_path, ("tls/no-such-host.invalid:7450", closed))
    text = explain_failure(settings, "Timeout!")
    assert "`no-such-host.invalid` is not a known host name" in text
    assert f"{closed}: no router listens there" in text


def test_explain_failure_names_key_of_another_certificate(running: Running, tmp_path: Path) -> None:
    site, _ = running
    own = settings_with(site.keys, tmp_path / "own", endpoints(site))
    other = settings_with(site.keys, tmp_path / "other", endpoints(site))
    text = refusal(NetworkSettings(own.endpoints, own.ca, own.certificate, other.key))
    assert "cannot be used" in text
    assert "rcdeploy keys APP.ddsl" in text


def test_network_settings_refuse_key_that_others_can_read(running: Running, tmp_path: Path) -> None:
    site, _ = running
    settings = settings_with(site.keys, tmp_path, endpoints(site))
    settings.key.chmod(0o640)
    text = refusal(settings)
    assert "made.key is a private key that other users can use (mode 640)" in text
    assert "chmod 600" in text


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{", "is not valid JSON"),
        ("[]", "must be a JSON object with exactly"),
        ('{"endpoints": [], "ca": "a", "certificate": "b", "key": "c"}', "must be a list such as"),
        (
            '{"endpoints": ["tcp/10.0.0.2:7450"], "ca": "a", "certificate": "b", "key": "c"}',
            "without TLS there is no connection between hosts",
        ),
        (
            '{"endpoints": ["tls/10.0.0.2:99999"], "ca": "a", "certificate": "b", "key": "c"}',
            "is not an endpoint",
        ),
        (
            '{"endpoints": ["tls/10.0.0.2:7450"], "ca": 3, "certificate": "b", "key": "c"}',
            '"ca" must be the path of a file',
        ),
    ],
)
def test_read_network_settings_names_invalid_field(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "network.json"
    path.write_text(text)
    with pytest.raises(InvalidNetwork, match=message):
        read_network_settings(path)


def test_network_settings_name_missing_files(tmp_path: Path) -> None:
    path = tmp_path / "network.json"
    path.write_text(
        '{"endpoints": ["tls/10.0.0.2:7450"], "ca": "ca.pem", "certificate": "b", "key": "c"}'
    )
    settings = read_network_settings(path)
    assert settings.ca == tmp_path / "ca.pem"
    assert "ca.pem cannot be read: No such file" in refusal(settings)
    with pytest.raises(InvalidNetwork, match=r"nothing\.json cannot be read"):
        read_network_settings(tmp_path / "nothing.json")

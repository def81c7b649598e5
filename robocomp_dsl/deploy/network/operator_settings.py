"""How the tools of this user reach the domain of a deployment over hosts.

In: a deployment, its domain, its keys. Out: a file that `find_network_settings` finds by domain.
"""

from __future__ import annotations

from robocomp_dsl.deploy.network.identities import OPERATOR
from robocomp_dsl.deploy.network.key_folder import AUTHORITY, KeyFolder, write_private
from robocomp_dsl.deploy.network.router_plan import operator_endpoints
from robocomp_dsl.model.deployment import Deployment
from robocomp_dsl.runtime.presence.network_settings import NetworkSettings, domain_settings_path


def operator_settings(deployment: Deployment, folder: KeyFolder) -> NetworkSettings:
    """The connection of rcdeploy to the routers, with the operator's certificate."""
    return NetworkSettings(
        operator_endpoints(deployment),
        folder.certificate(AUTHORITY),
        folder.certificate(OPERATOR),
        folder.key(OPERATOR),
    )


def write_operator_settings(deployment: Deployment, domain: str, folder: KeyFolder) -> None:
    """Let `rcdeploy echo`, `param` and all others reach the domain. Raises `UnsafeKeys`, `OSError`.

    The file names the operator's key; it does not contain it.
    """
    path = domain_settings_path(domain)
    path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    settings = operator_settings(deployment, folder)
    write_private(path, settings.to_json(path.parent).encode())


def remove_operator_settings(domain: str) -> None:
    """The deployment has been removed from its hosts."""
    domain_settings_path(domain).unlink(missing_ok=True)

"""Finding codes of the network of a deployment: keys and certificates."""

from __future__ import annotations

from robocomp_dsl.diagnostics import Code, Severity

KEYS_MISSING = Code(
    "RC850",
    Severity.ERROR,
    "keys of the deployment are missing",
    """\
Components on several hosts talk over TLS, and each has a certificate of its own. The command
`keys` makes a certificate authority (CA) for the deployment, and a certificate for each component,
for the router of each host, and for rcdeploy. It only adds what is missing:

    rcdeploy keys app.ddsl
    rcdeploy app.ddsl up

The keys are in `~/.config/robocomp/keys/NAME`. Another machine that deploys needs a copy of this
folder; keys that are made anew are not accepted by what already runs.
""",
)

CERTIFICATE_EXPIRED = Code(
    "RC851",
    Severity.ERROR,
    "expired certificate",
    """\
A certificate is valid for a limited time: 90 days unless `--days` says otherwise. A process that
is already connected stays connected; one that starts is refused. Renew, and deploy:

    rcdeploy keys app.ddsl
    rcdeploy app.ddsl up
""",
)

CERTIFICATE_NOT_YET_VALID = Code(
    "RC852",
    Severity.ERROR,
    "certificate that is not valid yet",
    """\
The certificate begins in the future: the clock of this machine is slow, or it was fast when the
certificate was made. Set the clock (`timedatectl set-ntp true`), and if the certificates are wrong,
make them again:

    rcdeploy keys app.ddsl --renew
""",
)

AUTHORITY_EXPIRED = Code(
    "RC853",
    Severity.ERROR,
    "expired certificate authority",
    """\
The certificate authority (CA) of the deployment has ended; no certificate that it signed is
accepted. Make a new one, with new certificates for all, and deploy to all hosts at once:

    rcdeploy keys app.ddsl --renew
    rcdeploy app.ddsl up
""",
)

KEY_READABLE = Code(
    "RC854",
    Severity.ERROR,
    "private key that others can read",
    """\
Whoever can read a private key can act as the component, or as rcdeploy. Files with keys must have
mode 0600, and their folder 0700:

    chmod 700 ~/.config/robocomp/keys/NAME
    chmod 600 ~/.config/robocomp/keys/NAME/*.key

If others have used this machine meanwhile, also make new keys: `rcdeploy keys app.ddsl --renew`.
""",
)

FOREIGN_AUTHORITY = Code(
    "RC855",
    Severity.ERROR,
    "certificate of another authority",
    """\
A certificate was signed by another certificate authority (CA) than the one in the folder of keys,
or the CA on a host is another one. This happens when keys are made anew on a second machine while
the hosts have those of the first. Copy the folder of keys from the first machine, or replace the
keys on all hosts:

    rcdeploy keys app.ddsl --renew
    rcdeploy app.ddsl up
""",
)

KEY_UNUSABLE = Code(
    "RC856",
    Severity.ERROR,
    "key or certificate that cannot be used",
    """\
A file in the folder of keys cannot be read, is damaged, or a key does not belong to its
certificate. Delete the file and make it again:

    rm ~/.config/robocomp/keys/NAME/arm.*
    rcdeploy keys app.ddsl
""",
)

CERTIFICATE_OUTDATED = Code(
    "RC857",
    Severity.ERROR,
    "certificate for another address",
    """\
The certificate of a router lists the addresses at which it may be reached. The address of the host
in the DDSL file is not one of them: it has changed since the certificate was made.

    rcdeploy keys app.ddsl
""",
)

RESERVED_NAME = Code(
    "RC858",
    Severity.ERROR,
    "reserved name of a component",
    """\
The certificate with the name `rcdeploy` belongs to the operator, who may use everything. In a
deployment over several hosts no component has this name.

Wrong:

    component rcdeploy;

Right:

    component deployer;
""",
)

CERTIFICATE_ENDS_SOON = Code(
    "RC859",
    Severity.WARNING,
    "certificate that ends soon",
    """\
Less than a third of the life of a certificate is left. Renew it now; the next `up` copies the new
one and restarts what uses it:

    rcdeploy keys app.ddsl
    rcdeploy app.ddsl up
""",
)

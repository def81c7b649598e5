"""The computers of a deployment, reached by OpenSSH: connections, checks, facts, locks."""

"""The network of deployments over hosts."""

"""The network of a deployment over hosts: keys, certificates, routers, access rules."""

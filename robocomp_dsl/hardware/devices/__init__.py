"""Device data and the Protocols of their drivers, one module per kind of device."""

"""Programs that systemd units run on a host beside the components; standard library only."""

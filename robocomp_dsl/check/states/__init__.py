"""State machines in SMDSL and SCXML."""

"""CDR encoding and decoding; `codec` is the entry point."""

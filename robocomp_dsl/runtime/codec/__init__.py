"""CDR encoding and decoding. `codec` has the functions that others call."""

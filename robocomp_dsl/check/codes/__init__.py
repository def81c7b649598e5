"""The finding codes of the check stage; import the family that you use (`check.codes.names`)."""

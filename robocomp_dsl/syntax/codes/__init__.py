"""The finding codes of the syntax stage; import the family that you use (`syntax.codes.legacy`)."""

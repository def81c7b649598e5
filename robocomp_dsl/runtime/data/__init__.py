"""Values of IDSL types: structs, struct arrays, conversion, type hashes."""

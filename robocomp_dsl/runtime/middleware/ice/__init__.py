"""ZeroC Ice 3.7: `transport` connects one component."""

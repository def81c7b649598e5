"""zenoh: `middleware` connects one component."""

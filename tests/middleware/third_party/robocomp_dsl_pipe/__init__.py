"""A middleware of another distribution: messages with a length in front, over unix sockets."""

"""local: components of one user on one machine, over unix sockets and shared memory."""

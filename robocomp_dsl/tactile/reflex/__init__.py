"""The withdrawal reflex: receptive fields, the force and distance law, frames, withdrawals."""

"""Monitors and arbitration: what checker and components share. Standard library only."""

"""Tests of what is copied to hosts."""

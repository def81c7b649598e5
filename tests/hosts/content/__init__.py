"""What is copied to simulated hosts."""

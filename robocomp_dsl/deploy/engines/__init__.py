"""What runs a plan: today `local`, the supervisor of one machine."""

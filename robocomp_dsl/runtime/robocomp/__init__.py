"""What workers of RoboComp expect at run time: its timers, signals, machines and settings."""

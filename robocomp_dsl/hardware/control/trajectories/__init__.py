"""References of n joints over time: minimum-jerk motions, velocity ramps, direct positions."""

"""The generic arm: servo mapping, kinematic chain, inverse kinematics, its state and commands."""

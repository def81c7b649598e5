"""From references to joint torques: PID banks, impedance, currents, the control law."""

"""What protects joints and motors: limits, fault detection, the watchdog of streamed references."""

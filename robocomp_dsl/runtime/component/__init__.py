"""The running component: lifecycle, execution, ports, introspection, logs."""

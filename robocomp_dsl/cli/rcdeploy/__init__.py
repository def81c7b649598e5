"""The sub-commands of `rcdeploy`, one module each."""

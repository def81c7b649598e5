"""The sub-commands of `rcgen`, one module each."""

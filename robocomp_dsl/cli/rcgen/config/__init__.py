"""The sub-commands of `rcgen config`."""

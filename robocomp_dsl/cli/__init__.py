"""The commands `rcgen` and `rcdeploy`; the only place of the toolchain that prints."""

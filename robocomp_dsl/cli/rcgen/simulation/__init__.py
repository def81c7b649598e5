"""`rcgen simulator`, `hardware` and `view`: commands that work on worlds and models."""

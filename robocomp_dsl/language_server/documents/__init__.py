"""Open documents: synchronization, file watching, and when files are checked."""

"""Detection of breaking changes between two versions of descriptions; `compare` is the entry."""

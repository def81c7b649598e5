"""Ice encoding 1.1; `codec` is the entry point."""

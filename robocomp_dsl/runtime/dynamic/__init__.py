"""Types at run time: from the types of a component to its schema, and back."""

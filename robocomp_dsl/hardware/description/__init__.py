"""What a device or a world is, as data: scenes, skin, and the kind of a model file."""

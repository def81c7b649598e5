"""Models made visible: pictures without a screen, and a scene in the browser."""

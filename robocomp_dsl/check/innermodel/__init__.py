"""InnerModel worlds, their skin, and tactile descriptions."""

"""The tolerant XML reader for InnerModel and SCXML."""

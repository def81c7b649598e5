"""The error of an invalid setting of a component."""


class InvalidSetting(ValueError):
    """An invalid setting; the message shows the valid form."""

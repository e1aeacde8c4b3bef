"""What several folders of tests share."""

from hypothesis import settings

from tests.standin_fixture import standin

__all__ = ["standin"]

# How long an example takes says something of the machine, not of the code.
settings.register_profile("any machine")
settings.load_profile("any machine")

"""What several folders of tests share."""

import signal

from hypothesis import settings

from tests.standin_fixture import standin

__all__ = ["standin"]

# How long an example takes says something of the machine, not of the code.
settings.register_profile("any machine", deadline=None)
settings.load_profile("any machine")

# A shell that starts the tests in the background has SIGINT ignored, in every process that they start, too.
signal.signal(signal.SIGINT, signal.default_int_handler)

"""What several folders of tests share."""

from tests.standin_fixture import standin

__all__ = ["standin"]

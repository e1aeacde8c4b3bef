"""The folder of a user's named profiles."""

from pathlib import Path

import platformdirs


def profile_folder() -> Path:
    """Return the folder of a user's named profiles, by the system's convention."""
    return platformdirs.user_config_path("mc-nested", appauthor=False) / "profiles"

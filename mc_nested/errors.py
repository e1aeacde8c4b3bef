"""All errors that are raised on purpose. Each message is one line: what is wrong, and what to do."""


class McNestedError(Exception):
    """Root of every error that this project raises on purpose."""


class UserError(McNestedError):
    """Something that the user can fix: the command line prints it, and exits with 2."""


class ScenarioError(UserError):
    """A scenario that can't be found, read or built."""


class PresetError(UserError):
    """A preset that can't be found or read."""


class ProfileError(UserError):
    """A profile that can't be found or read, or doesn't fit what is on the screen."""


class FontError(UserError):
    """A font picture or jar that can't be used."""


class PictureError(UserError):
    """A file that is no picture, or can't be opened."""


class FilmError(UserError):
    """A film that can't be written: its folder, its format, or what writes it."""


class DivergedError(UserError):
    """A training whose networks hold what is no number: its learning rate is too high."""


class RecordingError(UserError):
    """A recording that can't be used: foreign, of another format, or nothing of it is left."""


class RunError(UserError):
    """An output folder, a run or a checkpoint that can't be used."""


class ClusterError(UserError):
    """A scheduler that can't be reached or may not be, keys that don't fit, or workers with other versions."""


class DesktopError(UserError):
    """No display, a session whose windows can't be driven, or no window of that title."""


class NoWindowError(DesktopError):
    """There is no window of that title: the game isn't running, or not under that name."""


class SeveralWindowsError(DesktopError):
    """Several windows have such a title: nobody can tell which is the game's."""


class ClipboardError(DesktopError):
    """A clipboard that can't be reached, or that holds what could not be put back."""


class LiveError(McNestedError):
    """The game did not do what was asked. Every key was released before this was raised."""


class NotInFrontError(LiveError):
    """Another window is in front: nothing was pressed."""


class WrongScreenError(LiveError):
    """The screen was not just seen to be the one that a press is meant for: nothing was pressed."""


class TakenOverError(LiveError):
    """The player has taken over: nothing is pressed until the game is given back."""


class StoppedError(LiveError):
    """The agent was stopped on purpose: nothing is pressed any more, and nothing is tried again."""


class UnreadableError(LiveError):
    """The debug screen could not be read for longer than the game may take to draw it."""


class NotConfirmedError(LiveError):
    """A move or a placed block was not seen on the screen in time."""


def with_extra(extra: str) -> str:
    """Return what to do where a package that an extra of pyproject.toml brings is missing."""
    return f"install mc-nested again with its extra, as '.[{extra}]' (docs/how-to/install.md)"

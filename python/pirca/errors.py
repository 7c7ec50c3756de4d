"""What can go wrong. The text of each is that of the command line, and each stands for one of its exit codes."""

__all__ = ["Error", "InputError", "RunError", "UsageError"]


class Error(Exception):
    """Anything that pirca refuses or fails to do."""


class RunError(Error, RuntimeError):
    """The run or one of its files failed (exit code 1)."""


class UsageError(Error, ValueError):
    """The arguments make no sense: an unknown option, a value that is not allowed (exit code 2)."""


class InputError(Error, ValueError):
    """The study or the wall is invalid; the text lists every fault (exit code 3)."""


for _error in (Error, RunError, UsageError, InputError):
    _error.__module__ = "pirca"

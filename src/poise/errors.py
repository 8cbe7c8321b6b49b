"""The errors that poise raises for a user's mistake; each says what was found, what was expected, what to do."""


class PoiseError(Exception):
    """Anything that poise refuses, with a message for the person at the keyboard."""


class FormatError(PoiseError):
    """A file that cannot be read as a recording; the message names the file and, where there is one, the line."""


class RecordingError(PoiseError, ValueError):
    """Samples that do not fit together: a wrong shape, rate, unit or axis name."""


class MethodError(PoiseError, ValueError):
    """A method that does not exist, or a parameter of the wrong kind or out of its range."""


class StateError(PoiseError, ValueError):
    """A saved stream that does not belong to this method, version or parameter set."""


class ResponseError(PoiseError, ValueError):
    """A response that is asked for wrongly or could not be given; the message says what to install or to change."""

"""What reading a source file, or the files of a program, may cost. Beyond a limit, the rest is not
read, and a finding says so.
"""

MAX_CHARACTERS = 4 << 20
"""The maximum length of a source file."""

BASE_STEPS = 200_000
"""The number of steps that executing any code may take."""

STEPS_PER_CHARACTER = 6
"""The number of further steps for each character of code, so that the time that it takes is linear
in its length.

Most code takes less than one, and compilers up to three: functions are executed up to three times,
and once for each call.
"""


class WorkLimitExceeded(Exception):
    """Executing code takes more steps than its length allows."""


class Work:
    """The steps that are left for code of a length: the evaluation of a term, a copy of a value, a
    condition that is looked at.
    """

    def __init__(self, length: int) -> None:
        self.limit = BASE_STEPS + STEPS_PER_CHARACTER * length
        self.left = self.limit

    def spend(self, steps: int = 1) -> None:
        """Takes steps off. Raises WorkLimitExceeded if none are left."""
        self.left -= steps
        if self.left < 0:
            raise WorkLimitExceeded

    def message(self, error: WorkLimitExceeded | RecursionError) -> str:
        """Returns which limit code exceeds, and what is not checked."""
        if isinstance(error, RecursionError):
            return "the code nests too deeply to be followed; what it creates is not checked"
        return (
            f"following the code takes more than {self.limit} steps, the limit for code of this "
            "length; what it creates is not checked"
        )

"""How to lint one input."""

from collections.abc import Callable
from typing import NamedTuple

from msaa_lint.core.allowance import Allowance
from msaa_lint.core.text.node import Limits
from msaa_lint.frame.devices import DeviceProfile

from .settings.selection import Severity


class LintOptions(NamedTuple):
    """How to lint one input.

    `format` forces a reader; None detects the format from content. `device` is the profile for
    descriptions that do not name a device, or only the one that they were captured on.
    `severity_in` has the severities in each file of a program, if they differ. `ignores` applies
    suppression comments, `prices` computes the prices of findings. `keys` is the number of
    undecided rules for which a key is looked up that they lack (None: of none), and with `all_keys`
    all such keys. `edits` writes the edits of fixes into the findings; trying the fixes does not
    need them.
    """

    severity: Severity
    limits: Limits = Limits()
    format: str | None = None
    device: DeviceProfile | None = None
    ignores: bool = True
    prices: bool = False
    keys: Allowance | None = Allowance()
    all_keys: bool = False
    severity_in: Callable[[str], Severity] | None = None
    edits: bool = True

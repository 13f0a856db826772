"""Settings of every test."""

import os
import signal

from tests.command import CACHES
from tests.strength import load_profile

load_profile()

# No test reads what another one kept, nor what the user's own runs did; a test of the cache names a
# folder.
os.environ["XDG_CACHE_HOME"] = CACHES

# What a test installs runs once or twice: compiling all of it takes longer.
os.environ["PIP_COMPILE"] = "0"

# A shell starts commands in the background with these signals ignored, and what the tests start
# would inherit that.
for _number, _handler in (
    (signal.SIGINT, signal.default_int_handler),
    (signal.SIGQUIT, signal.SIG_DFL),
    (signal.SIGHUP, signal.SIG_DFL),
):
    if signal.getsignal(_number) is signal.SIG_IGN:
        signal.signal(_number, _handler)

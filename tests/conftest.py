"""Settings of every test."""

import signal

from tests.strength import load_profile

load_profile()

# A shell starts commands in the background with these signals ignored, and what the tests start would inherit that.
for _number, _handler in ((signal.SIGINT, signal.default_int_handler), (signal.SIGQUIT, signal.SIG_DFL)):
    if signal.getsignal(_number) is signal.SIG_IGN:
        signal.signal(_number, _handler)

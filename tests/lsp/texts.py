"""What tests of the server expect."""

CODES = ["MSAA201", "MSAA403"]
"""The findings of `tests.descriptions.STORED`, at the first storeOp."""

"""The compression zstd, which Python has from version 3.14 on."""

import sys

if sys.version_info >= (3, 14):
    from compression.zstd import ZstdDecompressor as ZstdDecompressor
    from compression.zstd import compress as compress
    from compression.zstd import decompress as decompress
else:
    from backports.zstd import ZstdDecompressor as ZstdDecompressor
    from backports.zstd import compress as compress
    from backports.zstd import decompress as decompress

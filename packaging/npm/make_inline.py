"""Writes a module as JavaScript, compressed and in base64, for bundlers without assets: make_inline.py WASM OUT."""

import base64
import gzip
import sys

with open(sys.argv[1], "rb") as file:
    text = base64.b64encode(gzip.compress(file.read(), mtime=0)).decode()
with open(sys.argv[2], "w", encoding="utf-8") as file:
    file.write(f"// abut.wasm, compressed by gzip, in base64. Made by make_inline.py.\nexport const wasm =\n    '{text}';\n")

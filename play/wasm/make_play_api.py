"""Describes the C API and the functions of this folder as one JSON: make_play_api.py OUT.

The headers here are written as those of the C API; see abut/c/make_api_json.py.
"""

import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent.parent / "abut" / "c"))
import make_api_json  # noqa: E402


class ArgumentDocs(dict):
    """The arguments of this folder need no sentence of their own: the functions' comments explain them."""

    def __contains__(self, name):
        return True

    def __missing__(self, name):
        return ""


def main():
    api = make_api_json.Api()
    for header in make_api_json.HEADERS:
        api.read(header)
    api.docs = ArgumentDocs(api.docs)
    for header in sorted(HERE.glob("*.h")):
        api.read(f"../../play/wasm/{header.name}")
    pathlib.Path(sys.argv[1]).write_text(make_api_json.written(api.result))


if __name__ == "__main__":
    main()

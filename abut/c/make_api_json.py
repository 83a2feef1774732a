"""Describes the C API as JSON, for programs that generate bindings: enums, numbers, handles, callbacks, structs and functions.

    make_api_json.py            writes abut_api.json beside abut.h
    make_api_json.py --check    exits with 1 if that file is not up to date

It reads the headers as they are written here: a doc comment of /// lines, then declarations up to an empty line.
"""

import json
import pathlib
import re
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
HEADERS = ["types.h", "shape.h", "query.h", "world.h", "field.h", "walk_mesh.h", "bake.h"]


def fail(message):
    sys.exit(f"make_api_json.py: {message}")


def argument_docs():
    """The sentences of abut.h about arguments, by name."""
    docs = {}
    for line in (FOLDER / "abut.h").read_text().splitlines():
        match = re.match(r"//   ([\w, ]+): (.+)$", line)
        if match:
            for name in match[1].split(", "):
                docs[name] = match[2]
    return docs


def paragraphs(text):
    """The doc comment and the declarations of each block that has some."""
    doc, code = [], []
    for line in text.splitlines() + [""]:
        if line.startswith("///") and not code:
            doc.append(line[3:].strip())
        elif line.startswith("//") or (line.startswith("#") and not code):
            continue
        elif line.strip():
            code.append(line)
        elif code and "{" in "".join(code) and not any(re.match(r"^} \w+;$", c) for c in code):
            continue
        else:
            if code:
                yield " ".join(doc), "\n".join(code)
            doc, code = [], []


def members(body):
    """(declaration, doc) of each line of an enum or struct; a doc may go on in the next lines."""
    result = []
    for line in body.splitlines():
        match = re.match(r"\s*([^/]*?)[,;]?\s*(?:///<\s*(.*))?$", line)
        if match[1]:
            result.append([match[1].strip(), match[2] or ""])
        elif match[2]:
            result[-1][1] += " " + match[2]
    return result


class Api:
    def __init__(self):
        self.result = {key: [] for key in ("enums", "numbers", "handles", "callbacks", "structs", "functions")}
        self.docs = argument_docs()

    def names(self, key):
        return {entry["name"] for entry in self.result[key]}

    def argument(self, text):
        array = re.search(r"ABUT_ARRAY\(([^)]*)\)", text)
        optional = "ABUT_OPTIONAL" in text
        plain = re.sub(r"ABUT_ARRAY\([^)]*\)|ABUT_OPTIONAL", "", text).strip()
        match = re.match(r"(const )?(\w+)([\s*]|\* const\*)* ?\b(\w+)$", plain)
        if not match:
            fail(f"can't read the argument `{text}`")
        kind, name = match[2], match[4]
        pointers = plain.count("*")
        if name not in self.docs:
            fail(f"abut.h says nothing of the argument `{name}`")
        handle = kind in self.names("handles")
        if pointers == 0:
            direction = "in"
        elif handle and pointers == 1:
            direction = "in" if match[1] else "inout"
        elif handle and array:
            direction = "in"
        else:
            direction = "in" if match[1] or kind == "void" else "out"
        return {
            "name": name,
            "type": kind,
            "pointers": pointers,
            "direction": direction,
            "array": re.sub(r"\s*([*])\s*", r" \1 ", array[1]) if array else None,
            "optional": optional,
            "doc": self.docs[name],
        }

    def arguments(self, text):
        flat = " ".join(text.split())
        if flat == "void":
            return []
        # Commas within ABUT_ARRAY(...) don't occur.
        return [self.argument(part.strip()) for part in flat.split(",")]

    def enum(self, name, doc, body):
        values = []
        for text, value_doc in members(body):
            value_name, value = re.match(r"(\w+) = (\d+)$", text).groups()
            values.append({"name": value_name, "value": int(value), "doc": value_doc})
        self.result["enums"].append({"name": name, "doc": doc, "values": values})

    def struct(self, name, doc, body):
        entries = []
        for text, member_doc in members(body):
            match = re.match(r"(const )?(\w+)(\*?) (\w+)(?:\[(\d+)\])?$", text)
            if not match:
                fail(f"can't read the member `{text}` of {name}")
            entries.append({
                "name": match[4],
                "type": match[2],
                "pointers": len(match[3]),
                "array": int(match[5]) if match[5] else None,
                "doc": member_doc,
            })
        self.result["structs"].append({"name": name, "doc": doc, "members": entries})

    def read(self, header):
        for doc, code in paragraphs((FOLDER / header).read_text()):
            if match := re.match(r"typedef enum (\w+) \{\n(.*)\n\} \w+;$", code, re.S):
                self.enum(match[1], doc, match[2])
            elif match := re.match(r"typedef struct (\w+) \{\n(.*)\n\} \w+;$", code, re.S):
                self.struct(match[1], doc, match[2])
            elif match := re.match(r"typedef struct (\w+) \1;$", code):
                self.result["handles"].append({"name": match[1], "doc": doc})
            elif match := re.match(r"typedef (\w+) \(\*(\w+)\)\((.*)\);$", code, re.S):
                self.result["callbacks"].append(
                    {"name": match[2], "doc": doc, "returns": match[1], "arguments": self.arguments(match[3])})
            elif code.startswith("ABUT_API"):
                for text in filter(None, (part.strip() for part in code.split(";"))):
                    match = re.match(r"ABUT_API (const )?(\w+)(\*?) (\w+)\((.*)\)$", " ".join(text.split()))
                    if not match or not doc:
                        fail(f"can't read `{text}` of {header}, or it has no doc comment")
                    self.result["functions"].append({
                        "name": match[4],
                        "header": header,
                        "doc": doc,
                        "returns": match[2] + match[3],
                        "arguments": self.arguments(match[5]),
                    })
            elif match := re.match(r"typedef (\w+) (\w+);$", code):
                self.result["numbers"].append({"name": match[2], "type": match[1], "doc": doc})
            elif not code.startswith("ABUT_C_"):
                fail(f"can't read `{code}` of {header}")


def written(api):
    """One line for each entry, so that changes can be read."""
    lists = []
    for key, entries in api.items():
        lines = ",\n".join("    " + json.dumps(entry) for entry in entries)
        lists.append(f'  "{key}": [\n{lines}\n  ]')
    return "{\n" + ",\n".join(lists) + "\n}\n"


def main():
    api = Api()
    # Handles are named before they are used.
    for header in HEADERS:
        api.read(header)
    text = written(api.result)
    file = FOLDER / "abut_api.json"
    if sys.argv[1:] == ["--check"]:
        if not file.exists() or file.read_text() != text:
            fail("abut_api.json is not up to date: run make_api_json.py")
    elif sys.argv[1:]:
        fail("takes nothing but --check")
    else:
        file.write_text(text)


if __name__ == "__main__":
    main()

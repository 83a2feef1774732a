"""Validates a JSON file against a schema: validate_json.py SCHEMA FILE. Prints what is wrong, one line each."""

import json
import sys

import jsonschema


def main():
    schema, instance = (json.load(open(name, encoding="utf-8")) for name in sys.argv[1:3])
    jsonschema.Draft202012Validator.check_schema(schema)
    errors = list(jsonschema.Draft202012Validator(schema).iter_errors(instance))
    for error in errors:
        print(error.json_path, error.message[:500])
    sys.exit(1 if errors else 0)


main()

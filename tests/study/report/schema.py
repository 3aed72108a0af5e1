# SPDX-License-Identifier: Apache-2.0
"""The part of JSON Schema (2020-12) that docs/report.schema.json and docs/datasheet.schema.json use; all blocks and the
words of such a document; and how a test complains and ends."""
import re
import sys

TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "null": type(None)}
KNOWN = {"$schema", "$defs", "$ref", "title", "type", "required", "additionalProperties", "properties", "const", "enum", "oneOf",
         "items", "minItems", "maxItems", "minimum", "pattern"}


problems = []


def complain(text):
    problems.append(text)
    print(text)


def finish(of=""):
    print(f"{len(problems)} problems{of}")
    sys.exit(len(problems) > 0)


def blocks(content):
    for block in content:
        yield block
        yield from blocks(block.get("content", []))


def words(runs):
    return "".join(run if isinstance(run, str) else run["text"] for run in runs)


def is_of(value, name):
    if name in ("number", "integer"):
        return isinstance(value, (int, float)) and not isinstance(value, bool) and (name == "number" or value == int(value))
    return isinstance(value, TYPES[name])


def errors(value, schema, root, at="report"):
    """What is wrong with the value; nothing: it is as the schema says."""
    assert set(schema) <= KNOWN, f"a word that this validator does not know: {set(schema) - KNOWN}"
    if "$ref" in schema:
        yield from errors(value, root["$defs"][schema["$ref"].rsplit("/", 1)[1]], root, at)
        return
    names = schema.get("type", [])
    names = [names] if isinstance(names, str) else names
    if names and not any(is_of(value, name) for name in names):
        yield f"{at}: {str(value)[:60]} is not of type {names}"
        return
    if "const" in schema and value != schema["const"]:
        yield f"{at}: {str(value)[:60]} is not {schema['const']}"
    if "enum" in schema and value not in schema["enum"]:
        yield f"{at}: {str(value)[:60]} is none of {schema['enum']}"
    if "oneOf" in schema:
        found = [list(errors(value, option, root, at)) for option in schema["oneOf"]]
        if sum(not e for e in found) != 1:
            kind = value.get("kind") if isinstance(value, dict) else None
            told = [e for e in found if e and not any(f": {kind} is not" in text for text in e)] if kind else found
            yield f"{at}: as {sum(not e for e in found)} of {len(found)} forms: {[e[0] for e in told if e][:3]}"
    if isinstance(value, str) and "pattern" in schema and not re.search(schema["pattern"], value):
        yield f"{at}: '{value[:60]}' does not match {schema['pattern']}"
    if "minimum" in schema and value < schema["minimum"]:
        yield f"{at}: {value} is below {schema['minimum']}"
    if isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            yield f"{at}: {len(value)} items"
        for i, item in enumerate(value):
            yield from errors(item, schema.get("items", {}), root, f"{at}[{i}]")
    if isinstance(value, dict):
        for key in schema.get("required", []):
            if key not in value:
                yield f"{at}: no '{key}'"
        for key, member in value.items():
            if key in schema.get("properties", {}):
                yield from errors(member, schema["properties"][key], root, f"{at}.{key}")
            elif schema.get("additionalProperties", True) is False:
                yield f"{at}: '{key}' is in no schema"

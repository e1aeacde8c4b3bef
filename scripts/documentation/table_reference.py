"""The reference of a TOML file, made from the pydantic model that checks it: every table and key."""

import json
from typing import Any

from pydantic import BaseModel

from scripts.documentation.markdown_text import code, number, of_docstring, sentence, table

KINDS = {"string": "text", "integer": "whole number", "number": "number", "boolean": "true or false"}
"""JSON schema's types in words."""

Schema = dict[str, Any]


def markdown(model: type[BaseModel]) -> str:
    """Return a section for the keys at the top of the file, if there are any, and one for each table."""
    schema = model.model_json_schema(by_alias=False)
    required = schema.get("required", [])
    plain = {key: value for key, value in schema["properties"].items() if not _is_table(value)}
    top = f"## Top of the file\n\n{_keys(plain, required)}" if plain else ""
    tables = [
        _section(key, value, schema["$defs"], is_required=key in required)
        for key, value in schema["properties"].items()
        if _is_table(value)
    ]
    return "\n".join([*([top] if top else []), *tables])


def _section(key: str, value: Schema, models: Schema, *, is_required: bool) -> str:
    name = _model_of(value)
    if name is None:  # a table whose keys are the user's own
        return (
            f"## [{key}]\n\n{sentence(value['description'])} Each key is {words_of(value['additionalProperties'])}.\n"
        )
    below = models[name]
    heading = f"[[{key}]]" if value.get("type") == "array" else f"[{key}]"
    left_out = "This table may be left out.\n\n" if not is_required and value["default"] in (None, []) else ""
    text = of_docstring(below.get("description", ""))
    return f"## {heading}\n\n{text}\n\n{left_out}{_keys(below['properties'], below.get('required', []))}"


def _keys(properties: dict[str, Schema], required: list[str]) -> str:
    return table(
        ["key", "value", "left out", "what it is"],
        (
            [
                code(key),
                words_of(value),
                "must be there" if key in required else _default(value),
                sentence(value.get("description", "")),
            ]
            for key, value in properties.items()
        ),
    )


def words_of(schema: Schema) -> str:
    """Say in words what a value may be: its kind and its limits."""
    if "anyOf" in schema:
        return " or ".join(words_of(kind) for kind in schema["anyOf"] if kind.get("type") != "null")
    if "$ref" in schema:
        return f"a table of the keys of [{str(_model_of(schema)).lower()}]"
    if "const" in schema or "enum" in schema:
        return ", ".join(code(json.dumps(value)) for value in schema.get("enum", [schema.get("const")]))
    if schema["type"] == "array":
        return _list(schema)
    if schema["type"] == "object":
        return f"a table of {words_of(schema['additionalProperties'])}"
    return KINDS[schema["type"]] + _limits(schema)


def _list(schema: Schema) -> str:
    parts = [words_of(part) for part in schema.get("prefixItems", [])] or [words_of(schema["items"])]
    low, high = schema.get("minItems"), schema.get("maxItems")
    if low is None:
        return f"list: {parts[0]}"
    count = f"{low}" if low == high else f"{low} or more" if high is None else f"{low} to {high}"
    return f"list of {count}: {parts[0]}"


def _limits(schema: Schema) -> str:
    low, above = schema.get("minimum"), schema.get("exclusiveMinimum")
    high, below = schema.get("maximum"), schema.get("exclusiveMaximum")
    if low is not None and high is not None:
        return f", {number(low)} to {number(high)}"
    words = [("from", low), ("above", above), ("up to", high), ("below", below)]
    said = [f"{word} {number(value)}" for word, value in words if value is not None]
    return f", {' and '.join(said)}" if said else ""


def _default(schema: Schema) -> str:
    default = schema.get("default")
    return "" if default in (None, {}, []) else code(json.dumps(default, ensure_ascii=False))


def _is_table(schema: Schema) -> bool:
    return _model_of(schema) is not None or schema.get("type") == "object"


def _model_of(schema: Schema) -> str | None:
    """Return the name of the model below a key; None for a key that holds a value."""
    found = [kind.get("$ref") for kind in (schema, *schema.get("anyOf", []), schema.get("items", {}))]
    named = [reference for reference in found if reference]
    return named[0].rpartition("/")[2] if named else None

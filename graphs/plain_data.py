"""Records as plain data for JSON, from their fields; what differs from a field is named."""

from collections.abc import Iterable, Mapping
from dataclasses import fields, is_dataclass
from typing import Any

__all__ = ["fields_to_json", "plain_data"]


def fields_to_json(
    record: Any, *, without: Iterable[str] = (), keys: Mapping[str, str] | None = None, **values: object
) -> dict[str, Any]:
    """Return the fields of a record as plain data, in their order: tuples as lists, records by their `to_json`.

    Fields in `without` are left out, `keys` are those that are not called as their field is, and `values` stand
    in the place of fields.
    """
    out, renamed = set(without), keys or {}
    return {
        renamed.get(part.name, part.name): plain_data(values.get(part.name, getattr(record, part.name)))
        for part in fields(record)
        if part.name not in out
    }


def plain_data(value: Any) -> Any:
    """Return plain data: records by the names of their fields or their own `to_json`, arrays and tuples as lists."""
    if hasattr(value, "to_json"):
        return value.to_json()
    if hasattr(value, "tolist"):
        return value.tolist()
    if is_dataclass(value):
        return fields_to_json(value)
    if isinstance(value, Mapping):
        return {key: plain_data(part) for key, part in value.items()}
    if isinstance(value, (tuple, list)):
        return [plain_data(part) for part in value]
    return value

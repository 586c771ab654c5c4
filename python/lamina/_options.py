"""The options of `lamina.mesh()`, which come from the option tables of the C++ library."""

from __future__ import annotations

import functools
import inspect
import os
from collections.abc import Iterable, Mapping
from numbers import Integral, Real
from typing import Any, TypeVar

from . import _lamina
from ._errors import OptionTypeError


#: A function that takes **options.
Function = TypeVar("Function")


@functools.cache
def option_rows() -> dict[str, dict[str, Any]]:
    """Returns the row of each option by its name: key, kind, metavar, help, range, group and default."""
    return {row["key"]: row for row in _lamina.option_rows()}


def _is_switch(row: Mapping[str, Any]) -> bool:
    return bool(row["metavar"] == "no|yes")


def _is_choice(row: Mapping[str, Any]) -> bool:
    return row["kind"] == "word" and "|" in row["metavar"] and row["metavar"] == row["metavar"].lower()


def option_value(key: str, value: Any) -> bool | int | float | str | list[str]:
    """Returns the value as the C++ part takes it."""
    row = option_rows().get(key, {"metavar": "", "kind": ""})
    if isinstance(value, bool) or type(value).__name__ == "bool_" or type(value).__module__ == "numpy" and (
            getattr(value, "dtype", None) == bool):
        return ("yes" if value else "no") if _is_switch(row) else bool(value)
    if isinstance(value, Integral):
        return int(value)
    if isinstance(value, Real):
        return float(value)
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, Iterable) and not isinstance(value, (bytes, Mapping)):
        entries = [option_value("", entry) for entry in value]
        texts = [entry if isinstance(entry, str) else repr(entry) for entry in entries]
        return ",".join(texts) if row["kind"] == "word" else texts
    error = OptionTypeError(f"{key or 'a list'}: {type(value).__name__} {value!r:.40} is no value of an option")
    error.option = key
    raise error


def option_values(options: Mapping[str, Any]) -> list[tuple[str, Any]]:
    """Returns names and values of the options that are given; None counts as not given."""
    return [(key, option_value(key, value)) for key, value in options.items() if value is not None]


def type_of(row: Mapping[str, Any]) -> str:
    """Returns the type of an option as annotations write it."""
    if row["key"] == "background":
        return "str | PathLike[str] | tuple[Any, Any, Any]"
    if _is_switch(row):
        return "bool"
    if _is_choice(row):
        return "Literal[" + ", ".join(f'"{word}"' for word in row["metavar"].split("|")) + "]"
    types = {"number": "float", "number_or_range": "float | str", "number_or_word": "float | str",
             "length": "float | str", "count": "int", "count_or_auto": 'int | Literal["auto"]',
             "flag": "bool", "word": "str | float | Sequence[float]", "words": "str | Sequence[str | float]",
             "repeated": "str | float | Sequence[str | float]", "path": "str | PathLike[str]"}
    return types[row["kind"]]


def default_text(row: Mapping[str, Any]) -> str:
    """Returns the default of an option as a person reads it; empty where there is none."""
    default = row["default"]
    if default is None or row["kind"] == "flag" or default == []:
        return ""
    return f" [{default:g}]" if isinstance(default, float) else f" [{default}]"


def options_text() -> str:
    """Returns a description of all options for docstrings, under the headings of `lamina mesh --help`."""
    text, group = [], None
    for row in sorted(option_rows().values(), key=lambda row: _GROUPS.index(row["group"])):
        if row["group"] != group:
            group = row["group"]
            text.append(f"\n{group}:")
        bounds = f"; {row['range']}" if row["range"] else ""
        text.append(f"  {row['key']}: {row['help'].replace('--', '').strip()}{bounds}{default_text(row)}")
    return "\n".join(text).strip()


_GROUPS = ["Files", "Geometry", "Flow", "Layer", "Outer region", "Run"]


def with_options(function: Function) -> Function:
    """Gives a function that takes **options the signature and the description of all of them, for help()."""
    described: Any = function
    signature = inspect.signature(described)
    kept = [p for p in signature.parameters.values() if p.kind is not inspect.Parameter.VAR_KEYWORD]
    options = [inspect.Parameter(key, inspect.Parameter.KEYWORD_ONLY, default=None,
                                 annotation=f"{type_of(row)} | None") for key, row in option_rows().items()]
    described.__signature__ = signature.replace(parameters=kept + options)
    described.__doc__ = f"{inspect.cleandoc(described.__doc__)}\n\nOptions\n-------\n{options_text()}\n"
    return function

# SPDX-License-Identifier: Apache-2.0
"""Results that are tables: as frames of pandas, which is loaded on first use, and as HTML in notebooks."""
from __future__ import annotations

import dataclasses
import html
import math
from typing import Any, Dict, Iterable, Mapping, Sequence

from ._library import UnsupportedError


class Framed:
    """A result that is a table."""

    def _columns(self) -> Mapping[str, Any]:
        raise NotImplementedError

    def to_frame(self) -> Any:
        """The table as a pandas.DataFrame; an interval makes two columns, NAME_low and NAME_high."""
        try:
            import pandas  # type: ignore[import-not-found, import-untyped, unused-ignore]
        except ModuleNotFoundError:
            raise UnsupportedError("to_frame needs pandas (pip install pandas)") from None
        return pandas.DataFrame(dict(self._columns()))


def columns_of(rows: Sequence[Any]) -> Dict[str, Any]:
    """The members of dataclasses of one kind, by their names."""
    columns: Dict[str, Any] = {}
    for field in dataclasses.fields(rows[0]) if rows else ():
        values = [getattr(row, field.name) for row in rows]
        if isinstance(values[0], tuple) and len(values[0]) == 2:
            columns[f"{field.name}_low"], columns[f"{field.name}_high"] = zip(*values)
        else:
            columns[field.name] = values
    return columns


def number(x: Any, digits: int = 5) -> str:
    """A number as it stands in tables: five digits, nothing for NaN."""
    return "" if x is None or (isinstance(x, float) and math.isnan(x)) else f"{x:.{digits}g}" if isinstance(x, float) else str(x)


def table(head: Sequence[str], rows: Iterable[Sequence[Any]], caption: str = "") -> str:
    """An HTML table; every text in it is escaped."""
    def line(cells: Iterable[Any], tag: str) -> str:
        return "<tr>" + "".join(f"<{tag}>{html.escape(number(c))}</{tag}>" for c in cells) + "</tr>"

    title = f"<caption>{html.escape(caption)}</caption>" if caption else ""
    return f"<table>{title}<thead>{line(head, 'th')}</thead><tbody>{''.join(line(r, 'td') for r in rows)}</tbody></table>"

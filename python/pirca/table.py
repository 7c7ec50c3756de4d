"""Tables that polars, pandas and pyarrow take."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from pirca import _native

if TYPE_CHECKING:
    import pandas
    import polars

__all__ = ["Table"]


class Table:
    """A table of a run, read from its Parquet file.

    It speaks the Arrow PyCapsule protocol: `polars.DataFrame(table)`, `pyarrow.table(table)` and
    `pandas.DataFrame.from_arrow(table)` (pandas 3) take it as it is. A value that a wall does not have is null.

    Attributes
    ----------
    path : pathlib.Path
        The file.
    columns : list of str
        Names of the columns; each ends with its unit.
    """

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        self.columns, self._rows, self._stream = _native.table(self.path)

    def to_polars(self) -> polars.DataFrame:
        """As a `polars.DataFrame`."""
        import polars

        return polars.DataFrame(self)

    def to_pandas(self) -> pandas.DataFrame:
        """As a `pandas.DataFrame`, by way of pyarrow."""
        import pyarrow

        return pyarrow.table(self).to_pandas()

    def __arrow_c_stream__(self, requested_schema: Any = None) -> Any:
        # Another schema than its own is not made, which the protocol leaves open.
        return self._stream()

    def __len__(self) -> int:
        return self._rows

    def __repr__(self) -> str:
        return f"<Table {self.path.name}: {len(self)} rows, {len(self.columns)} columns>"

"""The store of a study: one zarr group, one chunk per block, and a ledger whose row of a block is written last.

A block counts as done when its row in the ledger exists and agrees with the checksum of the written data.
"""

from __future__ import annotations

import os
import time
import zlib
from collections.abc import Mapping
from contextlib import AbstractContextManager
from typing import Any, NamedTuple

import numpy as np

from dalembert.analysis.batch.batch_result import CODES, first_mark
from dalembert.arrays import Array, Ints, Tree
from dalembert.errors import MissingFileError, ModelError
from dalembert.saving import check_installed
from dalembert.studies.object_store import Objects, is_address
from dalembert.studies.store_folder import Folder

FIELDS = ("check", "ms", *CODES)
"""A row of the ledger: CRC-32 of the block's arrays plus one (0: not done), milliseconds, designs by status."""


class StoredArray(NamedTuple):
    """An array of the store: what each design has, its dimensions' names, and attributes."""

    shape: tuple[int, ...]
    dtype: str
    dimensions: tuple[str, ...]
    attributes: Tree


def checksum(block: Mapping[str, Array]) -> int:
    """CRC-32 of the arrays of a block, plus one.

    >>> checksum({"a": np.zeros(3)}) == checksum({"a": np.zeros(2)})
    False
    """
    crc = 0
    for name in sorted(block):
        crc = zlib.crc32(np.ascontiguousarray(block[name]).data, crc)
    return crc + 1


def ledger_row(block: Mapping[str, Array], ms: float) -> Ints:
    """Row of a block in the ledger."""
    codes = block["status"] if block["status"].ndim == 1 else first_mark(block["status"])
    return np.array([checksum(block), round(ms), *np.bincount(codes, minlength=len(CODES))], np.int64)


class Store:
    """A zarr group in a folder or in an object store; raises ModelError for what is none, or not of a study."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        check_installed("zarr", "a stored study", "study")
        self.place = Objects(str(path)) if is_address(path) else Folder(path)
        self.group: Any = None
        self.arrays: dict[str, Any] = {}

    def __str__(self) -> str:
        return str(self.place)

    def exists(self) -> bool:
        """True if a study exists; raises ModelError where something else exists."""
        return self.place.exists()

    def locked(self) -> AbstractContextManager[None]:
        """One run at a time writes it."""
        return self.place.locked()

    def create(
        self, attributes: Tree, count: int, block: int, layout: Mapping[str, StoredArray], table: Any
    ) -> None:
        """Make it, without a block."""
        self.place.create(lambda target: _fill(target, attributes, count, block, layout, table))

    def open(self, mode: str = "r+") -> Tree:
        """Its attributes."""
        import zarr

        if not self.exists():
            raise MissingFileError(str(self), "dalembert study run FILE creates one")
        try:
            self.group = zarr.open_group(self.place.group(), mode=mode, zarr_format=3)
            attributes = dict(self.group.attrs)
            self.arrays = {name: self.group[name] for name in [*attributes["blocks_of"], "ledger"]}
        except (KeyError, ValueError, TypeError, OSError) as error:
            raise self.unreadable(error) from None
        return attributes

    def unreadable(self, error: Exception) -> ModelError:
        """The sentence for a group whose attributes or arrays are not those of a study."""
        return ModelError(f"{self} is not a readable study: {error}", "run it again under another name")

    @property
    def names(self) -> list[str]:
        """Arrays of each block."""
        return [name for name in self.arrays if name != "ledger"]

    def resize(self, count: int, block: int) -> None:
        """Adds designs; the last block is computed again if it was not full. Existing blocks are kept."""
        before = int(self.group.attrs["designs"])
        if before % block:
            self.forget(before // block)
        for name in self.names:
            self.arrays[name].resize((count, *self.arrays[name].shape[1:]))
        self.arrays["ledger"].resize((-(-count // block), len(FIELDS)))
        self.group.attrs["designs"] = count
        self.open()

    def forget(self, b: int) -> None:
        """Take a block for not done, its chunks gone: a broken one could not be written over."""
        self.arrays["ledger"][b] = 0
        for name in self.names:
            rest = "/0" * (self.arrays[name].ndim - 1)
            self.place.remove(f"{name}/c/{b}{rest}")

    def put(self, b: int, block: int, count: int, arrays: Mapping[str, Array], ms: float) -> Ints:
        """Write a block, the ledger's row last."""
        self.place.check()
        which = slice(b * block, min((b + 1) * block, count))
        row = ledger_row(arrays, ms)
        for name, values in arrays.items():
            self.arrays[name][which] = values
        self.arrays["ledger"][b] = row
        return row

    def ledger(self) -> Ints:
        """All rows (block, field); a row that cannot be read is not done."""
        try:
            return np.asarray(self.arrays["ledger"][:])
        except Exception:  # whatever a codec says of a chunk that was cut
            return np.stack([self._row(b) for b in range(self.arrays["ledger"].shape[0])])

    def _row(self, b: int) -> Ints:
        try:
            return np.asarray(self.arrays["ledger"][b])
        except Exception:
            return np.zeros(len(FIELDS), np.int64)

    def sound(self, b: int, block: int, count: int, row: Ints) -> bool:
        """True if the stored data of a block agree with the checksum in its row of the ledger."""
        which = slice(b * block, min((b + 1) * block, count))
        try:
            stored = ledger_row({name: self.arrays[name][which] for name in self.names}, float(row[1]))
        except Exception:  # of a chunk that was cut or is unreadable
            return False
        return np.array_equal(stored, row)


def _fill(
    target: Any,
    attributes: Tree,
    count: int,
    block: int,
    layout: Mapping[str, StoredArray],
    table: Any,
) -> None:
    """The group and its arrays; the attributes last: one without them is half-made."""
    import zarr

    group = zarr.create_group(target, zarr_format=3, attributes={"dalembert": attributes["dalembert"]})
    for name, of in layout.items():
        group.create_array(
            name,
            shape=(count, *of.shape),
            chunks=(block, *of.shape),
            dtype=of.dtype,
            compressors=zarr.codecs.ZstdCodec(level=1) if of.dtype == "u1" else None,
            fill_value=255 if of.dtype == "u1" else np.nan,
            dimension_names=("design", *of.dimensions),
            attributes=of.attributes,
        )
    if table is not None:
        group.create_array("table", data=table, dimension_names=("design", "number"))
    rows = (-(-count // block), len(FIELDS))
    group.create_array(
        "ledger",
        shape=rows,
        chunks=(1, len(FIELDS)),
        dtype="i8",
        compressors=None,
        fill_value=0,
        dimension_names=("block", "field"),
        attributes={"fields": list(FIELDS)},
    )
    described = {
        "block": block,
        "designs": count,
        "blocks_of": list(layout),
        "created": time.strftime("%Y-%m-%dT%H:%M:%S"),
    }
    group.attrs.update({**attributes, **described})

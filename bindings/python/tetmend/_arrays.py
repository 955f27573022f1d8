# SPDX-License-Identifier: MIT
"""Named arrays on their way into the library, which knows four types of numbers, and back in the form that was given."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from tetmend._core import Error

def array_of(name: str, values: Any) -> NDArray[Any]:
    """What numpy makes of it; what it cannot is an error with its name.

    >>> array_of("tets", [[0, 1, 2, 3], [1, 2]])
    Traceback (most recent call last):
    tetmend._core.Error: tets is no array: its rows differ in length
    """
    try:
        array = np.asarray(values)
    except ValueError as error:
        reason = "its rows differ in length" if "inhomogeneous" in str(error) else str(error)
        raise Error(f"{name} is no array: {reason}") from None
    if np.ma.is_masked(values):
        raise Error(f"{name} has masked values, which have no meaning here: fill them, or leave them out")
    return array


_KNOWN = {np.dtype(t) for t in (np.int32, np.int64, np.float32, np.float64)}


@dataclass(frozen=True)
class Form:
    """What an array looked like: type of its numbers, and shape of those of one element."""

    dtype: np.dtype[Any]
    shape: tuple[int, ...]

    def restore(self, values: NDArray[Any]) -> NDArray[Any]:
        shaped = values.reshape((len(values), *self.shape))
        return shaped if shaped.dtype == self.dtype else shaped.astype(self.dtype)


Forms = dict[str, Form]


def _known(place: str, values: NDArray[Any]) -> NDArray[Any]:
    """The numbers as one of the four types, none of them changed."""
    kind, size = values.dtype.kind, values.dtype.itemsize
    native = values.dtype.newbyteorder("=")
    if native in _KNOWN:
        return np.ascontiguousarray(values, dtype=native)
    if kind == "b" or (kind in "iu" and size < 4):
        return values.astype(np.int32)
    if kind == "u":
        if size == 8 and values.size and values.max() > np.iinfo(np.int64).max:
            raise Error(f"{place} has numbers above 2^63 - 1")
        return values.astype(np.int64)
    if kind == "f" and size < 4:
        return values.astype(np.float32)
    raise Error(f"{place} has type {values.dtype}, but real numbers of up to 64 bits are wanted")


def pack(argument: str, data: Mapping[str, ArrayLike] | None, count: int) -> tuple[dict[str, NDArray[Any]], Forms]:
    """Arrays as the library takes them, (count, components), and their forms.

    >>> arrays, forms = pack("point_data", {"u": [[1.0, 2.0], [3.0, 4.0]]}, 2)
    >>> arrays["u"].shape, forms["u"].shape
    ((2, 2), (2,))
    >>> pack("point_data", {"u": [1.0, 2.0]}, 3)
    Traceback (most recent call last):
    tetmend._core.Error: point_data['u'] has shape (2,), but there are 3 of them
    """
    arrays: dict[str, NDArray[Any]] = {}
    forms: Forms = {}
    if data is not None and not isinstance(data, Mapping):
        raise Error(f"{argument} is of type {type(data).__name__}, but a dict of arrays is wanted")
    for name, given in (data or {}).items():
        place = f"{argument}[{name!r}]"
        if not isinstance(name, str) or not name:
            raise Error(f"{place}: a name is text that is not empty")
        values = array_of(place, given)
        if values.ndim == 0 or len(values) != count:
            raise Error(f"{place} has shape {values.shape}, but there are {count} of them")
        if 0 in values.shape[1:]:
            raise Error(f"{place} has shape {values.shape}: no numbers")
        columns = int(np.prod(values.shape[1:], dtype=np.int64))
        arrays[name] = np.ascontiguousarray(_known(place, values).reshape(count, columns))
        forms[name] = Form(values.dtype, values.shape[1:])
    return arrays, forms


def unpack(arrays: Mapping[str, NDArray[Any]], forms: Forms) -> dict[str, NDArray[Any]]:
    """The same as they were given; those of a file as the library has them."""
    return {name: forms[name].restore(values) if name in forms else values for name, values in arrays.items()}

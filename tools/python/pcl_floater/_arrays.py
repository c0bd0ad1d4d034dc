# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the functions take, and in which words they refuse what else they are given."""
import operator

import numpy as np


def as_rows(name, given, shapes="(n, 3)"):
    """The array of three columns that was given, not copied, with what the compiled part relies on."""
    if isinstance(given, np.ma.MaskedArray):
        raise TypeError(f"{name} is a masked array, whose mask would be lost; use "
                        f"{name}.filled(numpy.nan)")
    array = np.asarray(given)
    if array.dtype.names:
        raise TypeError(f"{name} is an array with the fields {', '.join(array.dtype.names)}; use "
                        f"numpy.column_stack(({name}['x'], {name}['y'], {name}['z'])), say")
    if array.dtype not in (np.float32, np.float64):
        raise TypeError(f"{name} must be an array of float32 or float64, not {array.dtype}; "
                        f"numpy.asarray({name}, float) converts it if it can be")
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"{name} must have the shape {shapes}, not {array.shape}")
    if len(array) >= 2**31:
        raise ValueError("more than 2147483647 points; reconstruct parts of the cloud")
    return array


def as_triangles(given):
    """The triangles as the compiled part expects them: copied where they are no such array."""
    array = np.asarray(given)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError(f"triangles must have the shape (m, 3), not {array.shape}")
    if array.size > 0 and array.dtype.kind not in "iu":
        raise TypeError(f"triangles must be an array of whole numbers, not of {array.dtype}")
    if array.size > 0 and not 0 <= array.min() <= array.max() < 2**31:
        raise ValueError("triangles have an index that is negative, or too large")
    return np.ascontiguousarray(array, np.uint32)


def _is_bool(given):
    return isinstance(given, (bool, np.bool_))


def as_flag(name, given):
    if not _is_bool(given):
        raise TypeError(f"{name} must be True or False, not {given!r}")
    return bool(given)


def as_whole(name, given):
    try:
        whole = operator.index(None if _is_bool(given) else given)
    except TypeError:
        raise TypeError(f"{name} must be a whole number, not {given!r}") from None
    if not -2**31 <= whole < 2**31:
        raise ValueError(f"{name} must be a number of 32 bits, not {given!r}")
    return whole


def as_number(name, given):
    if _is_bool(given) or not hasattr(given, "__float__"):
        raise TypeError(f"{name} must be a number, not {given!r}")
    return float(given)


def as_place(name, given):
    try:
        place = [as_number(name, number) for number in given]
    except TypeError:
        raise TypeError(f"{name} must be three numbers, not {given!r}") from None
    if len(place) != 3:
        raise ValueError(f"{name} must be three numbers, not {given!r}")
    return place


def as_callable(name, given):
    if given is not None and not callable(given):
        raise TypeError(f"{name} must be a callable, not {given!r}")
    return given


def as_option(row, given):
    """The value of an option, of which the table has the row."""
    name, kind, values = row["name"], row["kind"], row["values"]
    if kind == "place":
        words = "'auto', 'none' or three numbers"
        if given is None:
            raise TypeError(f"{name} must be {words}; 'none' says that the cloud is no single scan")
        if isinstance(given, str) and given not in ("auto", "none"):
            raise ValueError(f"{name} must be {words}, not {given!r}")
        return given if isinstance(given, str) else as_place(name, given)
    if kind == "word" and not (isinstance(given, str) and given in values):
        raise (ValueError if isinstance(given, str) else TypeError)(
            f"{name} must be one of {', '.join(map(repr, values))}, not {given!r}")
    return {"word": lambda _, word: word, "bool": as_flag, "int": as_whole, "float": as_number}[kind](name, given)

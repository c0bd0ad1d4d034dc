# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the functions take for arrays, and in which words they refuse others."""
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

# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
from functools import cached_property
from typing import Any, Callable, Dict, List, Literal, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str
__all__: List[str]

class FloaterError(RuntimeError):
    status: str
    report: Dict[str, Any]
    def __init__(self, message: str, status: str, report: Dict[str, Any]) -> None: ...

class Mesh:
    points: NDArray[np.floating[Any]]
    triangles: NDArray[np.int32]
    warnings: Tuple[str, ...]
    parameters: Optional[NDArray[np.float64]]
    loop: NDArray[np.int32]
    unused: NDArray[np.int32]
    outliers: NDArray[np.int32]
    scatter: NDArray[np.int32]
    non_finite: NDArray[np.int32]
    duplicates: NDArray[np.int32]
    def __init__(
        self,
        points: NDArray[np.floating[Any]],
        arrays: Dict[str, Any],
        warnings: Tuple[str, ...],
        report: Dict[str, Any],
    ) -> None: ...
    @cached_property
    def report(self) -> Dict[str, Any]: ...

class Texture:
    coordinates: NDArray[np.float32]
    points: NDArray[np.int32]
    corners: NDArray[np.int32]
    charts: NDArray[np.int32]
    seams: NDArray[np.int32]
    report: Dict[str, Any]
    def __init__(self, arrays: Dict[str, Any], report: Dict[str, Any]) -> None: ...

def vertex_normals(
    points: ArrayLike,
    triangles: ArrayLike,
    *,
    threads: int = 0,
) -> NDArray[np.float32]: ...
def texture_coordinates(
    points: ArrayLike,
    triangles: ArrayLike,
    *,
    largest_stretch: float = 1.06,
    whole_discs: bool = False,
    threads: int = 0,
    progress: Optional[Callable[[str, float], object]] = None,
) -> Texture: ...
def reconstruct(
    points: ArrayLike,
    *,
    normals: Optional[ArrayLike] = None,
    sensor_origin: Optional[Sequence[float]] = None,
    use_input_normals: bool = False,
    loop: Optional[Union[Sequence[int], NDArray[np.integer[Any]]]] = None,
    strict: bool = False,
    progress: Optional[Callable[[str, float], object]] = None,
    # doc/make_options.py writes these.
    # End.
) -> Mesh: ...

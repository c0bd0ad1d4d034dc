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
    threads: int = 0,
    method: Literal["auto", "tw385"] = "auto",
    topology: Literal["auto", "disc", "surface"] = "auto",
    holes: Literal["auto", "close-all", "keep-largest", "keep-count", "by-size"] = "auto",
    kept_loops: int = 1,
    largest_hole: float = 0.0,
    largest_hole_length: float = 0.0,
    viewpoint: Union[Literal["auto", "none"], Sequence[float]] = "auto",
    facing: Literal["auto", "outwards", "up", "viewpoint", "normals", "inwards"] = "auto",
    max_edge: float = 0.0,
    max_edge_ratio: float = 0.0,
    min_component: int = 0,
    remove_outliers: bool = True,
    scatter: Literal["auto", "keep", "drop"] = "auto",
    denoise: bool = True,
    flips: bool = True,
    uncross: bool = True,
    open_crossings: bool = False,
    neighbors: int = 20,
    neighborhood: Literal["nearest-delaunay", "nearest", "ball-delaunay", "ball"] = "nearest-delaunay",
    ball_radius: float = 2.25,
    sheet_filter: bool = True,
    boundary: Optional[Literal["consensus", "two-segments"]] = None,
    opening_angle: float = 160.0,
    cluster_tolerance: float = 0.05,
    cluster_neighbors: int = 10,
    domain: Literal["circle", "square", "polygon"] = "circle",
    sides: int = 6,
    spacing: Literal["chord-length", "centripetal", "uniform"] = "chord-length",
    weights: Literal["uniform", "inverse-distance", "shape-preserving", "mean-value"] = "mean-value",
    solver: Literal["umfpack", "bicgstab-ilut"] = "umfpack",
    ordering: Optional[Literal["automatic", "amd", "metis", "reverse-cuthill-mckee", "natural"]] = None,
    tolerance: float = 1e-15,
    max_iterations: int = 1000,
    ilut_fill: int = 15,
    ilut_drop: float = 0.01,
    # End.
) -> Mesh: ...

# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions for any triangle mesh, and the exception of the module."""
import numpy as np

from . import _core
from ._arrays import as_callable, as_flag, as_number, as_rows, as_triangles, as_whole


class FloaterError(RuntimeError):
    """There is no mesh. The text names the cause, and what to do.

    Attributes
    ----------
    status : str
        The outcome in one word, such as "TOO_FEW_POINTS" or "NO_BOUNDARY"; "REFUSED" if it was
        `strict` that refused the mesh. doc/troubleshooting.md has all of them.
    report : dict
        The report on the run, as `Mesh.report`. Its "message" is the text of the exception. Empty if it
        is `texture_coordinates` that failed.
    """

    __module__ = "pcl_floater"

    def __init__(self, message, status, report):
        super().__init__(message)
        self.status = status
        self.report = report

    def __reduce__(self):
        return type(self), (str(self), self.status, self.report)


class Texture:
    """Texture coordinates of a mesh: a layout of its triangles in the unit square, without overlaps.

    The surface is cut into charts, each a disc. A point on a seam between charts has several
    coordinates, so that the triangles name coordinates of their own.

    Attributes
    ----------
    coordinates : numpy.ndarray, shape (c, 2), float32
        u and v, 0 to 1; v goes up, as in OBJ files.
    points : numpy.ndarray, shape (c,), int32
        The point of each of the coordinates.
    corners : numpy.ndarray, shape (m, 3), int32
        Of each triangle, the coordinates of its corners, anti-clockwise.
    charts : numpy.ndarray, shape (m,), int32
        The chart of each triangle, from 0 on.
    seams : numpy.ndarray, shape (k, 2), int32
        The two points of each edge between charts.
    report : dict
        "charts": how many there are. "flipped": triangles that do not run anti-clockwise, 0 unless some
        are too small for single precision. "stretch", "largest_stretch": of the whole and of the worst
        triangle, 1 if there is none (L2 and L-infinity stretch, Sander et al. 2001). "area_used": share
        of the square that triangles cover. "seam_length": in units of the points. "gutter": least
        distance of two charts, in sides of the square.
    """

    def __init__(self, arrays, report):
        vars(self).update(arrays)
        self.report = report

    def __repr__(self):
        return (f"<pcl_floater.Texture: {self.report['charts']} charts, "
                f"{len(self.coordinates)} coordinates, stretch {self.report['stretch']:.3f}>")


def vertex_normals(points, triangles, *, threads=0):
    """Normals of the vertices of a triangle mesh.

    The mean of the normals of the triangles around each vertex, weighted by their angles there. They
    point to where the triangles face: of a mesh of `reconstruct`, to its front.

    Parameters
    ----------
    points : array, shape (n, 3), float32 or float64
    triangles : array of whole numbers, shape (m, 3)
        Points of each triangle, anti-clockwise as seen from the front. The mesh may be any.
    threads : int
        Threads to use. 0: one for each core.

    Returns
    -------
    numpy.ndarray, shape (n, 3), float32
        Of length 1; (0, 0, 0) for points in no triangle, and where the normals around cancel out.

    Raises
    ------
    ValueError, TypeError
        An array is of a wrong shape or type, or a triangle names a point that is not there.

    Examples
    --------
    >>> mesh = reconstruct(points)
    >>> vertex_normals(mesh.points, mesh.triangles).shape
    (4000, 3)
    """
    rows, corners = _mesh(points, triangles)
    return np.asarray(_core.vertex_normals(rows, corners, _threads(threads)))


def texture_coordinates(points, triangles, *, largest_stretch=1.06, whole_discs=False, threads=0,
                        progress=None):
    """Lays a triangle mesh out in the unit square, without overlaps.

    Parameters
    ----------
    points : array, shape (n, 3), float32 or float64
    triangles : array of whole numbers, shape (m, 3)
        An oriented manifold, such as a mesh of `reconstruct`. Points in no triangle get no coordinates.
    largest_stretch : float
        Mean stretch above which a chart is cut further, 1 or more. More gives fewer and larger charts.
    whole_discs : bool
        Components that are discs are one chart each, however much that stretches them.
    threads : int
        Threads to use. 0: one for each core. The result is the same.
    progress : callable, optional
        As in `reconstruct`; the stage is "texture".

    Returns
    -------
    Texture

    Raises
    ------
    FloaterError
        There are none; `status` is "INVALID_INDICES" if the mesh is no oriented manifold, or has points
        that are not finite.
    ValueError, TypeError
        An argument is out of its range, or of a wrong shape or type.
    KeyboardInterrupt
        Ctrl-C ends the run.

    Examples
    --------
    >>> mesh = reconstruct(points)
    >>> texture = texture_coordinates(mesh.points, mesh.triangles)
    >>> texture.corners.shape
    (8000, 3)
    >>> texture.report["flipped"]
    0
    """
    rows, corners = _mesh(points, triangles)
    status, message, report, arrays = _core.texture_coordinates(
        rows, corners, as_number("largest_stretch", largest_stretch), as_flag("whole_discs", whole_discs),
        _threads(threads), as_callable("progress", progress))
    if status == "INVALID_OPTION":
        raise ValueError(message)
    if status != "SUCCESS":
        raise FloaterError(message, status, {})
    return Texture({name: np.asarray(values) for name, values in arrays.items()}, report)


def _mesh(points, triangles):
    rows, corners = as_rows("points", points), as_triangles(triangles)
    if corners.size > 0 and corners.max() >= len(rows):
        raise ValueError(f"a triangle names point {corners.max()}, and there are {len(rows)} points")
    return rows, corners


def _threads(given):
    threads = as_whole("threads", given)
    if threads < 0:
        raise ValueError("the number of threads must be 0 (all cores) or more")
    return threads

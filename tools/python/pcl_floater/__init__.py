# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Surface reconstruction from point clouds.

Turns an unorganized point cloud into a triangle mesh whose vertices are the points of the cloud. The
surface may be open or closed, with holes, handles or several components, or a single scan of a depth
camera or a lidar. It needs no normals and no tuning.

    import numpy as np
    import pcl_floater

    mesh = pcl_floater.reconstruct(points)   # points: array of the shape (n, 3)
    corners = mesh.points[mesh.triangles]    # (m, 3, 3): the three corners of each triangle
"""
import functools
import inspect
import textwrap

import numpy as np

from . import _arrays, _core
from ._core import __version__
from ._on_meshes import FloaterError, Texture, texture_coordinates, vertex_normals

__all__ = ["FloaterError", "Mesh", "Texture", "reconstruct", "texture_coordinates", "vertex_normals"]


class Mesh:
    """A triangle mesh, and the report on the run that made it. `reconstruct` makes them.

    All indices count the points of the cloud, from 0. The arrays own the memory of the
    reconstruction: nothing has been copied. All may be changed, and a mesh can be pickled.

    Attributes
    ----------
    points : numpy.ndarray, shape (n, 3), float32 or float64
        The cloud, as it was given: the same array, if it was one of this shape. Vertices of the mesh.
    triangles : numpy.ndarray, shape (m, 3), int32
        Points of each triangle, anti-clockwise as seen from the front.
    warnings : tuple of str
        What is odd about the cloud and the mesh, one sentence each. Empty if nothing is.
    parameters : numpy.ndarray, shape (n, 2), float64, or None
        Of a disc: the position of each point in the plane, NaN where it was not used. Triangles run
        anti-clockwise there. None of other surfaces; see `topology="disc"`.
    loop : numpy.ndarray, shape (k,), int32
        The longest boundary loop, in order, each point once. Empty if the surface is closed.
    unused : numpy.ndarray, shape (k,), int32
        Finite points, neither duplicates nor outliers, that are in no triangle; ascending.
    outliers : numpy.ndarray, shape (k,), int32
        Points that were left out of the mesh as outliers; ascending.
    scatter : numpy.ndarray, shape (k,), int32
        Points of no surface, such as leaves; left out of the mesh but with `scatter="keep"`; ascending.
    non_finite : numpy.ndarray, shape (k,), int32
        Points with a NaN or infinite coordinate, which are in no triangle; ascending.
    duplicates : numpy.ndarray, shape (k, 2), int32
        Repeated points, which are in no triangle, each with the equal point that is; ascending.
    report : dict
        The report on the run.
    """

    def __init__(self, points, arrays, warnings, report):
        self.points = points
        vars(self).update(arrays)
        self.warnings = warnings
        self._report = report

    @functools.cached_property
    def report(self):
        """The report on the run: a dict with the keys of the JSON report of the tool, but for those
        on files and memory. It holds numbers, strings, lists and dicts only, so that json.dump()
        takes it. Made when it is first read: the lists of points become lists of Python."""
        return _with_lists(self._report, vars(self))

    def __repr__(self):
        return (f"<pcl_floater.Mesh: {len(self.points)} points, {len(self.triangles)} triangles, "
                f"{len(self.warnings)} warnings>")


def _with_lists(report, arrays):
    """The report with the lists of points."""
    names = ("loop", "unused", "outliers", "scatter", "non_finite", "duplicates")
    return {**report, **{name: arrays[name].tolist() for name in names}}


def _as_list(name, given):
    """The rows of a list, or of an organized cloud."""
    array = np.asanyarray(given)
    if array.ndim != 3 or array.shape[2] != 3:
        return _arrays.as_rows(name, given, "(n, 3) or (rows, columns, 3)")
    return _arrays.as_rows(name, array.reshape(-1, 3))


def _loop(given):
    """The indices as a list of int."""
    array = np.asarray(given)
    if array.ndim != 1:
        raise ValueError(f"loop must be a list of indices, not an array of the shape {array.shape}")
    if array.size > 0 and array.dtype.kind not in "iu":
        raise TypeError(f"loop must be a list of whole numbers, not of {array.dtype}")
    if array.size > 0 and not 0 <= array.min() <= array.max() < 2**32:
        raise ValueError("loop has an index that is negative, or too large")
    return array.tolist()


def _options(given):
    """The options that were given, of the types of the table."""
    table = {row["name"]: row for row in _TABLE}
    options = {name: value for name, value in given.items() if value is not None or name not in _BY_METHOD}
    for name in options:
        if name not in table:
            raise TypeError(f"reconstruct() has no argument {name!r}")
        options[name] = _arrays.as_option(table[name], options[name])
    if options.get("largest_hole") and options.get("largest_hole_length"):
        raise ValueError("largest_hole and largest_hole_length are one size in two units; give one of them")
    return options


def _signature_and_text():
    """Of the options: the parameters of `reconstruct`, and what its documentation says of them."""
    parameters, text = [], ""
    for row in _TABLE:
        default = None if row["name"] in _BY_METHOD else row["default"]
        parameters.append(inspect.Parameter(row["name"], inspect.Parameter.KEYWORD_ONLY, default=default))
        values = row["values"]
        kind = "{%s}" % ", ".join(f'"{word}"' for word in values) if row["kind"] == "word" else {
            "bool": "bool", "int": f"int, {values}", "float": f"float, {values}",
            "place": '"auto", "none" or three numbers'}[row["kind"]]
        body = textwrap.fill(row["text"][0].upper() + row["text"][1:] + ".", 102)
        text += f"{row['name']} : {kind}\n" + textwrap.indent(body, "    ") + "\n"
    return parameters, textwrap.indent(text, "    ").strip()


_TABLE = _core.options()
# Their defaults depend on the method.
_BY_METHOD = ("boundary", "ordering")
_PARAMETERS, _TEXT = _signature_and_text()


def reconstruct(points, *, normals=None, sensor_origin=None, use_input_normals=False, loop=None, strict=False,
                progress=None, **options):
    """Reconstructs the surface on which points lie.

    The names, values and defaults are those of the tool pcl_floater_reconstruct. The defaults need no
    tuning. The result does not depend on the number of threads or on the order of the points. Other
    threads of Python run meanwhile, and may call this function, too. The points are copied once, into
    the double precision in which all is computed: 24 bytes per point, with up to some hundred more
    during the run.

    Parameters
    ----------
    points : array, shape (n, 3) or (rows, columns, 3), float32 or float64
        The cloud. It may have any strides, so that `scan[:, :3]` is not copied. Points with a NaN or
        infinite coordinate, and repeated points, are in no triangle. Of an organized cloud, as a depth
        camera gives it, the points are counted row by row.
    normals : array, of the shape of the points, float32 or float64, optional
        Normals of the points, of any length. With `facing` "auto" or "normals" they tell where the
        front is; see also `use_input_normals`. Where one is zero or not finite, it tells nothing.
    sensor_origin : three numbers, optional
        Where the sensor of a single scan was, if that is known but not sure to fit: it is used if the
        spacing of the points confirms it. The mesh faces it where it can.

    use_input_normals : bool
        Take `normals` for the tangent planes as well.
    loop : sequence of int, optional
        The boundary loop of a disc: indices of points, in order. Makes a disc.
    strict : bool
        Raise `FloaterError` with the status "REFUSED" if the mesh is poor, or if points are in no triangle.
    progress : callable, optional
        Called as progress(stage, fraction) by this thread, when a stage begins and up to 20 times a
        second: the name of the stage, and the fraction of the run that is done, from 0 to 1. An
        exception that it raises ends the run, and is raised here.

    %OPTIONS%

    Returns
    -------
    Mesh

    Raises
    ------
    FloaterError
        There is no mesh; `status` tells why.
    ValueError
        An argument is out of its range, no word of those that are possible, of a wrong shape, or does
        not fit the others.
    TypeError
        An argument is of a wrong type, or unknown.
    KeyboardInterrupt
        Ctrl-C ends the run, mostly within a tenth of a second. Only the solution of a linear system,
        of a disc, is not interrupted.

    Examples
    --------
    >>> mesh = reconstruct(points, holes="close-all")
    >>> mesh.triangles.shape
    (8000, 3)
    >>> mesh.report["check"]["genus"]
    1
    """
    strict = _arrays.as_flag("strict", strict)
    progress = _arrays.as_callable("progress", progress)
    use_input_normals = _arrays.as_flag("use_input_normals", use_input_normals)
    array = _as_list("points", points)
    options = _options(options)
    if sensor_origin is not None:
        sensor_origin = _arrays.as_place("sensor_origin", sensor_origin)
        if not np.isfinite(sensor_origin).all():
            raise ValueError("sensor_origin must have finite coordinates")
    if normals is None and use_input_normals:
        raise ValueError("use_input_normals=True needs normals")
    if normals is not None:
        normals = _as_list("normals", normals)
        if not use_input_normals and options.get("facing", "auto") not in ("auto", "normals"):
            raise ValueError("normals are given, but facing does not ask for them: leave them out, or set "
                             "facing='normals' or use_input_normals=True")
        if len(normals) != len(array):
            raise ValueError(f"there are {len(normals)} normals of {len(array)} points; give one for each point")
    status, message, objection, warnings, known, arrays = _core.run(
        array, normals, sensor_origin, use_input_normals, [] if loop is None else _loop(loop), options, progress)
    arrays = {name: None if values is None else np.asarray(values) for name, values in arrays.items()}
    if strict and objection:
        status, message = "REFUSED", f"{objection}, which strict does not allow"
    report = {
        "version": __version__,
        "input": {"points": len(array), "coordinates": "float" if array.itemsize == 4 else "double"},
        "options": known.pop("options"), "strict": strict, "status": status, "message": message,
        "warnings": list(warnings), **known}
    if status != "SUCCESS":
        raise FloaterError(message, status, _with_lists(report, arrays))
    return Mesh(array, arrays, tuple(warnings), report)


reconstruct.__doc__ = (reconstruct.__doc__ or "").replace("%OPTIONS%", _TEXT)
reconstruct.__signature__ = inspect.Signature([
    *(p for p in inspect.signature(reconstruct).parameters.values() if p.kind is not p.VAR_KEYWORD), *_PARAMETERS])

# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The exception of the module."""


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

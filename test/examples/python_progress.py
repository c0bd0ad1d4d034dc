# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""A run that tells how far it is, and one that is ended early. Ctrl-C would end it as well."""
import sys

import numpy as np
import pcl_floater

x, y = np.meshgrid(np.arange(60.0), np.arange(60.0))
points = np.stack([x, y, np.sin(0.2 * x) * np.cos(0.1 * y)], axis=-1).reshape(-1, 3)

told = []


def progress(stage, fraction):
    told.append(fraction)
    print(f"{100 * fraction:3.0f} %  {stage}")


mesh = pcl_floater.reconstruct(points, progress=progress)


class Cancelled(Exception):
    pass


def cancel(stage, fraction):
    if fraction > 0.3:  # or when a window was closed, say
        raise Cancelled


try:
    pcl_floater.reconstruct(points, progress=cancel)
    was_cancelled = False
except Cancelled:
    was_cancelled = True

sys.exit(0 if told[-1] == 1 and was_cancelled else 1)

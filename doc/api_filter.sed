# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# What doxygen reads of a header instead (sed -E).
# The name of a parameter that is not used is in a comment.
s,/\*([a-z_]+)\*/,\1,g
# What all classes of PCL have, and PCL describes.
s,^( *)(using (Ptr|ConstPtr|PointCloud) = ),\1/** \\brief As in other classes of PCL. */ \2,
s,^( *)((std::string getClassName|void performReconstruction) \(),\1/** \\brief As in other classes of PCL. */ \2,

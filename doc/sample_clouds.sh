#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# The clouds of doc/tuning.md, doc/formats.md, doc/airborne.md and doc/pipelines.md that pcl_floater_generate does not
# make. One unit of length is about one spacing.
set -euo pipefail

if (($# > 0)); then
  echo "Usage: sample_clouds.sh
Writes small clouds for the examples of the pages in doc to the working directory."
  [[ $1 == -h || $1 == --help ]] && exit 0
  exit 1
fi

# cloud SEED PROGRAM: runs it by awk; r () is a random number from 0 to 1, the same on every system.
cloud () {
  awk "function r() { return (seed = seed * 16807 % 2147483647) / 2147483647 }
       function point(x, y, z) { print \"v\", x, y, z }
       BEGIN { seed = $1; $2 }"
}

# A sheet with a third of its points missing, and a hole 6 wide.
cloud 7 'for (i = 0; i < 80; i++) for (j = 0; j < 80; j++) {
  x = i + 0.4 * r(); y = j + 0.4 * r()
  if ((x - 40)^2 + (y - 40)^2 > 9 && r() > 0.3) point(x, y, 3 * sin(x / 12)) }' >thin.obj

# A sheet with a hole 12 wide.
cloud 5 'for (i = 0; i < 80; i++) for (j = 0; j < 80; j++) {
  x = i + 0.4 * r(); y = j + 0.4 * r()
  if ((x - 40)^2 + (y - 40)^2 > 36) point(x, y, 3 * sin(x / 12)) }' >shadow.obj

slope='for (i = 0; i < 60; i++) for (j = 0; j < 60; j++) {
  x = i + 0.4 * r(); y = j + 0.4 * r(); point(x, y, 2 * sin(i / 9)) }'

# A slope, and above it points strewn into a ball, like the leaves of a tree.
cloud 2 "$slope; for (n = 0; n < 2500; n++) {
  d = 8 * r()^(1 / 3); z = 2 * r() - 1; a = 6.2831853 * r(); w = d * sqrt(1 - z * z)
  point(30 + w * cos(a), 30 + w * sin(a), 16 + d * z) }" >tree.obj

# A slope, and above it five patches of 16 points.
cloud 3 "$slope; for (n = 0; n < 5; n++) for (i = 0; i < 4; i++) for (j = 0; j < 4; j++) {
  x = 10 * n + i + 0.3 * r(); y = 20 + j + 0.3 * r(); point(x, y, 12 + n) }" >crumbs.obj

# Three quarters of a tube around the axis z.
cloud 5 'for (i = 0; i < 60; i++) for (j = 0; j < 40; j++) {
  a = 4.712389 * (i + 0.4 * r()) / 60; z = j + 0.4 * r(); point(12 * cos(a), 12 * sin(a), z) }' >tube.obj

# A scan from the origin: a wall, a round plate before it, and noise along the rays.
cloud 4 'for (i = -60; i < 60; i++) for (j = -60; j < 60; j++) {
  u = i / 80; v = j / 80; d = u * u + v * v < 0.04 ? 2.5 : 4 + 0.5 * sin(3 * u) * cos(2 * v)
  d += 0.02 * (r() - 0.5); point(u * d, v * d, d) }' >scan.obj

# A slope in map coordinates, as text: one file says float, the other double.
slope_on_map () {
  printf 'ply\nformat ascii 1.0\nelement vertex 3600\n'
  printf 'property %s %s\n' "$1" x "$1" y "$1" z
  echo end_header
  cloud 5 'for (i = 0; i < 60; i++) for (j = 0; j < 60; j++) {
    x = 500000 + i + 0.4 * r(); y = 5500000 + j + 0.4 * r()
    printf "%.3f %.3f %.3f\n", x, y, 300 + 2 * sin(i / 9) }'
}
slope_on_map float >map_float.ply
slope_on_map double >map_double.ply

# A slope with colours, normals that point up, and an intensity.
{
  printf 'ply\nformat ascii 1.0\nelement vertex 3600\n'
  printf 'property %s\n' 'float x' 'float y' 'float z' 'uchar red' 'uchar green' 'uchar blue' \
    'float nx' 'float ny' 'float nz' 'float intensity'
  echo end_header
  cloud 5 'for (i = 0; i < 60; i++) for (j = 0; j < 60; j++) {
    x = i + 0.4 * r(); y = j + 0.4 * r()
    print x, y, 2 * sin(i / 9), 4 * i, 120, 4 * j, 0, 0, 1, int(100 * r()) }'
} >coloured.ply

# Airborne: ground with a house (class 6) and a tree (5), of which pulses go on to the ground; noise; withheld points.
{
  echo x,y,z,return_number,number_of_returns,classification,withheld
  cloud 6 'for (i = 0; i < 80; i++) for (j = 0; j < 80; j++) {
      x = i + 0.4 * r(); y = j + 0.4 * r(); d = sqrt((x - 60)^2 + (y - 50)^2); h = x - 26 > 0 ? x - 26 : 26 - x
      house = i > 17 && i < 35 && j > 23 && j < 49; ground = 2 * sin(i / 15)
      row = sprintf("%.2f,%.2f", 500000 + x, 5500000 + y)
      print row "," (house ? 14 - 0.6 * h : ground) "," (d < 9 ? "2,2" : "1,1") "," (house ? 6 : 2) ",0"
      if (d < 9 && r() < 0.8) print row "," (ground + 6 + 9 * r()) ",1,2,5,0"
      if (r() < 0.002) print row "," (70 + 9 * r()) ",1,1,18,0"
      if (r() < 0.002) print row "," (-30 - 9 * r()) ",1,1,7,0"
      if (r() < 0.002) print row "," (ground + 3) ",1,1,2,1" }'
} >airborne.csv

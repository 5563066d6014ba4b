# SPDX-FileCopyrightText: 2026 The PaGO authors
# SPDX-License-Identifier: BSD-3-Clause
#
# What a trajectory in KITTI rows (3 x 4 matrix, row by row) amounts to: number of poses, words that are no finite
# number, length of the path, max - min of the yaw followed through full turns, largest distance from the first position.
function square(v) { return v * v }
function distance(x, y, z) { return sqrt(square($4 - x) + square($8 - y) + square($12 - z)) }

{
  if (NF != 12) bad += 1
  for (i = 1; i <= NF; ++i)
    if ($i !~ /^[-+]?[0-9]+\.?[0-9]*([eE][-+]?[0-9]+)?$/) ++bad
  now = atan2($5, $1)
  if (NR == 1) {
    x0 = $4; y0 = $8; z0 = $12
    yaw = low = high = now
  } else {
    length_m += distance(x, y, z)
    turned = now - before
    while (turned > pi) turned -= 2 * pi
    while (turned < -pi) turned += 2 * pi
    yaw += turned
    if (yaw < low) low = yaw
    if (yaw > high) high = yaw
    if (distance(x0, y0, z0) > furthest) furthest = distance(x0, y0, z0)
  }
  x = $4; y = $8; z = $12
  before = now
}
BEGIN { pi = atan2(0, -1); length_m = 0; furthest = 0; bad = 0 }
END {
  print "poses", NR
  print "bad_words", bad
  printf "length_m %.9f\n", length_m
  printf "yaw_range_deg %.9f\n", (high - low) * 180 / pi
  printf "furthest_m %.9f\n", furthest
}

// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/ply.hpp"

#include <cstring>
#include <vector>

#include "output/scratch_folder.hpp"
#include "pago/core/error.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago::output;
using Catch::Matchers::Contains;
using pago::test::contents;
using pago::test::ScratchFolder;

std::string body(const std::string& ply) {
  const std::string end = "end_header\n";
  return ply.substr(ply.find(end) + end.size());
}

TEST_CASE("a map has its points as 14 little-endian bytes each, and gives them back", "[output][ply]") {
  const std::vector<PlyPoint> points{{1.0F, -2.0F, 0.5F, 200, 1}, {0.0F, 0.0F, 0.0F, 0, 0}};
  const std::string head = map_header(points.size());
  CHECK_THAT(head, Catch::Matchers::StartsWith("ply\nformat binary_little_endian 1.0\n"));
  CHECK_THAT(head, Contains("element vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
                            "property uchar intensity\nproperty uchar ground\nend_header\n"));
  std::string bytes;
  for (const PlyPoint& point : points) append(bytes, point);
  // 1.0 = 3f800000, -2.0 = c0000000, 0.5 = 3f000000
  std::string expected("\x00\x00\x80\x3f\x00\x00\x00\xc0\x00\x00\x00\x3f\xc8\x01", 14);
  expected.append(14, '\0');
  CHECK(bytes == expected);
  const PlyPoint back = ply_point(bytes.data());
  CHECK(back.x_m == 1.0F);
  CHECK(back.y_m == -2.0F);
  CHECK(back.z_m == 0.5F);
  CHECK(back.intensity == 200);
  CHECK(back.ground == 1);
}

TEST_CASE("a coloured PLY has 15 bytes per point", "[output][ply]") {
  const ScratchFolder scratch;
  write_ply(scratch.path / "scan.ply", std::vector<ColouredPoint>{{1.0F, -2.0F, 0.5F, {255, 0, 7}}});
  const std::string ply = contents(scratch.path / "scan.ply");
  CHECK_THAT(ply, Contains("property float z\nproperty uchar red\nproperty uchar green\n"
                           "property uchar blue\nend_header\n"));
  CHECK(body(ply) == std::string("\x00\x00\x80\x3f\x00\x00\x00\xc0\x00\x00\x00\x3f\xff\x00\x07", 15));
}

TEST_CASE("large scans are whole", "[output][ply]") {
  const ScratchFolder scratch;
  std::vector<ColouredPoint> points(150'000);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].x_m = static_cast<float>(i);
  write_ply(scratch.path / "scan.ply", points);
  const std::string bytes = body(contents(scratch.path / "scan.ply"));
  REQUIRE(bytes.size() == 15 * points.size());
  for (const std::size_t i : {0U, 65'535U, 65'536U, 131'072U, 149'999U}) {
    float x_m = 0.0F;
    std::memcpy(&x_m, bytes.data() + 15 * i, sizeof x_m);
    CHECK(x_m == static_cast<float>(i));
  }
}

TEST_CASE("an empty scan is a valid file, a full disk an Error", "[output][ply]") {
  const ScratchFolder scratch;
  write_ply(scratch.path / "scan.ply", std::vector<ColouredPoint>{});
  CHECK_THAT(contents(scratch.path / "scan.ply"), Contains("element vertex 0\n"));
  CHECK_THROWS_WITH(write_ply("/dev/full", std::vector<ColouredPoint>(10)),
                    Contains("/dev/full: cannot be written"));
}

}  // namespace

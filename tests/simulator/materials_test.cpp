// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/simulator/materials.hpp"

#include <algorithm>
#include <cmath>

#include "support/catch.hpp"

using namespace pago::simulator;

TEST_CASE("ground stands out of its triangles by a few millimetres, in hollows wider than a hand",
          "[simulator][materials]") {
  double sum_m = 0.0, squares_m2 = 0.0, steepest = 0.0;
  constexpr int kPlaces = 20000;
  constexpr double kHand_m = 0.1;
  for (int k = 0; k < kPlaces; ++k) {
    const double x_m = 0.37 * k, y_m = -0.11 * k;
    const double height_m = relief_m(Material::kAsphalt, x_m, y_m);
    sum_m += height_m;
    squares_m2 += height_m * height_m;
    const double beside_m = relief_m(Material::kAsphalt, x_m + kHand_m, y_m);
    steepest = std::max(steepest, std::abs(beside_m - height_m) / kHand_m);
  }
  CHECK(std::abs(sum_m / kPlaces) < 5e-4);
  const double rms_m = std::sqrt(squares_m2 / kPlaces);
  CHECK(rms_m > 0.005);
  CHECK(rms_m < 0.010);
  CHECK(steepest < 0.08);
}

TEST_CASE("ground is as high again when seen again, and as high under a lane's paint",
          "[simulator][materials]") {
  const double height_m = relief_m(Material::kAsphalt, 1234.5, -67.8);
  CHECK(height_m != 0.0);
  CHECK(relief_m(Material::kAsphalt, 1234.5, -67.8) == height_m);
  CHECK(relief_m(Material::kPaint, 1234.5, -67.8) == height_m);
  CHECK(relief_m(Material::kAsphalt, 1235.2, -67.8) != height_m);
}

TEST_CASE("walls and cars are as flat as their triangles", "[simulator][materials]") {
  for (const Material material :
       {Material::kPlaster, Material::kBrick, Material::kGlass, Material::kCarPaint})
    CHECK(relief_m(material, 3.3, 4.4) == 0.0);
}

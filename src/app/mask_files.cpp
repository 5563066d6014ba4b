// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mask_files.hpp"

#include <cmath>
#include <vector>

#include "pago/core/text.hpp"
#include "pago/output/picture.hpp"
#include "pago/output/ply.hpp"
#include "pago/output/text_file.hpp"

namespace pago::app {
namespace {

namespace fs = std::filesystem;

/// As in the PaGO paper's Fig. 3.
constexpr output::Colour kGreen{0, 170, 60}, kRed{220, 40, 30};

void write_ply(const fs::path& file, const Sweep& sweep) {
  std::vector<output::ColouredPoint> points;
  for (std::uint32_t i = 0; i < sweep.size; ++i)
    points.push_back({sweep.x_m[i], sweep.y_m[i], sweep.z_m[i], sweep.ground[i] == kGround ? kGreen : kRed});
  output::write_ply(file, points);
}

void write_picture(const fs::path& file, const Sweep& sweep) {
  constexpr int kPixels = 1000;
  constexpr float kPixels_per_m = 10.0F;
  output::Picture picture(kPixels, kPixels);
  // What stands on the ground is drawn over it.
  for (const std::uint8_t drawn : {kGround, kNonGround}) {
    for (std::uint32_t i = 0; i < sweep.size; ++i) {
      const float right = -sweep.y_m[i] * kPixels_per_m, up = sweep.x_m[i] * kPixels_per_m;
      if (sweep.ground[i] != drawn || !(std::hypot(right, up) < kPixels)) continue;
      picture.set(kPixels / 2 + static_cast<int>(std::floor(right)),
                  kPixels / 2 - 1 - static_cast<int>(std::floor(up)), drawn == kGround ? kGreen : kRed);
    }
  }
  picture.save(file);
}

}  // namespace

MaskFiles::MaskFiles(fs::path folder, const Kinds& kinds) : folder_(std::move(folder)), kinds_(kinds) {
  output::make_folders(folder_);
}

void MaskFiles::write(const Sweep& sweep) const {
  const fs::path base = folder_ / format("%06llu", static_cast<unsigned long long>(sweep.header.sequence));
  const auto named = [&](const char* extension) { return fs::path(base.string() + extension); };
  output::write_file(named(".mask"),
                     {reinterpret_cast<const char*>(sweep.ground.data()), std::size_t{sweep.size}});
  if (kinds_.ply) write_ply(named(".ply"), sweep);
  if (kinds_.picture) write_picture(named(".png"), sweep);
}

}  // namespace pago::app

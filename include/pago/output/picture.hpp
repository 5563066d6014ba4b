// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace pago::output {

/// Red, green, blue.
using Colour = std::array<std::uint8_t, 3>;

/// A picture that is drawn pixel by pixel, black to begin with; (0, 0) is the upper left corner. [set-up]
class Picture {
 public:
  Picture(int width, int height);

  /// Pixels outside are left out.
  void set(int x, int y, const Colour& colour);
  /// Writes a PNG. Error when that cannot be done.
  void save(const std::filesystem::path& file) const;

 private:
  int width_, height_;
  std::vector<Colour> pixels_;
};

}  // namespace pago::output

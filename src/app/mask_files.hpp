// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "pago/core/sweep.hpp"

namespace pago::app {

/// The files of one ground method, a set per sweep, by the sweep's number:
///   000000.mask   one byte for each return (of KITTI scans: each point), in order; 1 ground, 0 not
///   000000.ply    on request: the returns, ground green, all else red
///   000000.png    on request: the same from above, 100 m across, x upwards
class MaskFiles {
 public:
  struct Kinds {
    bool ply = false, picture = false;
  };

  /// Makes the folder. Throws Error, as write() does.
  MaskFiles(std::filesystem::path folder, const Kinds& kinds);
  void write(const Sweep& sweep) const;

 private:
  std::filesystem::path folder_;
  Kinds kinds_;
};

}  // namespace pago::app

// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pago::perf {

/// How fast this machine moves memory at this moment: copies as many bytes as a sweep holds. A stage's time
/// divided by this one's, measured in turns with it, says more about the stage than either alone: what slows
/// the machine slows both.
class CopyKernel {
 public:
  explicit CopyKernel(std::size_t bytes);

  /// The thread's CPU time for one copy, the best of four: what the stage has left of the caches should not
  /// matter.
  double run_ms() noexcept;

 private:
  void copy() noexcept;

  std::vector<std::uint8_t> source_, target_;
};

}  // namespace pago::perf

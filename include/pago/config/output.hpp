// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "pago/config/describe.hpp"

namespace pago {

/// [output]
struct OutputConfig {
  std::string folder = "results";
  double flush_interval_s = 1.0;
  int trace_sweeps = 300;
};

template <typename Visitor>
void describe(Visitor& v, OutputConfig& c) {
  v("folder", c.folder, "each run makes a folder of its own in this one");
  v("flush_interval_s", c.flush_interval_s, within(0.0, 3600.0),
    "poses reach the disk at least this often; 0: each at once");
  v("trace_sweeps", c.trace_sweeps, within(0, 100000),
    "sweeps that trace.json shows, the last of the run; 0: no trace");
}

}  // namespace pago

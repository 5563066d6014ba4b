// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "pago/config/config.hpp"
#include "pago/core/sources.hpp"
#include "pago/hdl64/calibration.hpp"

namespace pago {

/// A recording's sweeps one after the other, on the caller's thread: for tools that look at sweeps and do not
/// drive. They are the same that a replay makes, partial ones at either end included (SweepHeader::is_posed);
/// none is dropped, and those of a source that knows labels are labelled.
///
/// Holds a reference to the source. [set-up] the constructors: allocate; [one thread] next().
class SweepReader {
 public:
  SweepReader(const Config& config, PacketSource& source, const hdl64::Calibration& calibration);
  SweepReader(const Config& config, SweepSource& source);
  ~SweepReader();

  /// Valid until the next call; the caller may write into it. Null at the end, which may be an early one: see
  /// failure().
  Sweep* next();

  /// Why there are no sweeps, or no more: the stream is not the sensor's, or a scan cannot be read. Empty if
  /// they came to their end. See also PacketSource::complaint().
  std::string failure() const;

 private:
  class Input;
  class Packets;
  class Scans;
  std::unique_ptr<Input> input_;
};

}  // namespace pago

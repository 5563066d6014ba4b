// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/assembly/packet_ingest.hpp"
#include "pago/platform/clock.hpp"

namespace pago {

/// What a live source needs beside its packets: somebody who notices that none come. [ingest thread]
class LiveWatch {
 public:
  /// After each receive().
  void after_batch(bool is_empty, PacketIngest& ingest) noexcept {
    const std::int64_t now_ns = platform::monotonic_ns();
    if (!is_empty) last_ns_ = now_ns;
    if (is_empty && now_ns - last_ns_ > kSilence_ns) ingest.note_silence();
    if (ingest.is_refused() && now_ns - probed_ns_ > kProbeAgain_ns) {
      ingest.probe_again();
      probed_ns_ = now_ns;
    }
  }

 private:
  // Later than the ingest itself would find the gap in the stamps, so that both come to the same.
  static constexpr std::int64_t kSilence_ns = PacketIngest::kBrokenOff_ns + 100'000'000;
  static constexpr std::int64_t kProbeAgain_ns = 1'000'000'000;

  std::int64_t last_ns_ = platform::monotonic_ns(), probed_ns_ = last_ns_;
};

}  // namespace pago

// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <string>

#include "pago/core/text.hpp"
#include "pago/output/sweep_record.hpp"

namespace pago::output {

/// Fingerprint of a trajectory: equal if and only if (but for chance, 1 in 2^64) every number of every pose
/// is equal to the last bit. 64-bit FNV-1a over the doubles' bytes, lowest byte first, so that it does not
/// depend on the machine's byte order. [any thread, one at a time] real-time safe but for hex().
class TrajectoryHash {
 public:
  void add(const PoseRow& pose) noexcept {
    for (const double number : pose) add_word(std::bit_cast<std::uint64_t>(number));
  }
  std::uint64_t value() const noexcept { return hash_; }
  /// 16 hexadecimal digits.
  std::string hex() const { return format("%016llx", static_cast<unsigned long long>(hash_)); }

 private:
  // Offset basis and prime: draft-eastlake-fnv, section 5.
  void add_word(std::uint64_t word) noexcept {
    for (int byte = 0; byte < 8; ++byte, word >>= 8U) {
      hash_ ^= word & 0xFFU;
      hash_ *= 0x00000100000001B3U;
    }
  }
  std::uint64_t hash_ = 0xCBF29CE484222325U;
};

}  // namespace pago::output

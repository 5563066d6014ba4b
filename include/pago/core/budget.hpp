// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pago {

/// How a stage that works in rounds learns that it must come to an end. Stages know no clock: whoever runs
/// them decides, by a deadline when live, not at all in replays, by what was written down when a live run is
/// replayed as it was. Asked between rounds; real-time safe.
class Budget {
 public:
  virtual ~Budget() = default;
  /// Whether another round may begin after `rounds` of them.
  virtual bool allows_after(int rounds) const noexcept = 0;
};

/// Lets every search come to its end.
class UnlimitedBudget final : public Budget {
 public:
  bool allows_after(int) const noexcept override { return true; }
};
inline const UnlimitedBudget kUnlimited;

}  // namespace pago

// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace pago {

/// What went wrong while something was being set up: a file, a setting, a device. Thrown by functions that
/// create; never by functions that process. The program prints it as one line and ends with exit code 2.
class Error : public std::runtime_error {
 public:
  /// `where` names the file, key, packet or device (with line or byte where known), `what` says what is wrong
  /// there, `hint` what the user can do about it (may be empty).
  Error(std::string where, std::string what, std::string hint = {})
      : std::runtime_error(where + ": " + what + (hint.empty() ? "" : " (" + hint + ")")),
        where_(std::move(where)),
        problem_(std::move(what)),
        hint_(std::move(hint)) {}

  const std::string& where() const noexcept { return where_; }
  const std::string& problem() const noexcept { return problem_; }
  const std::string& hint() const noexcept { return hint_; }

 private:
  std::string where_, problem_, hint_;
};

}  // namespace pago

// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "pago/output/pose_board.hpp"
#include "pago/output/text_file.hpp"

namespace pago::output {

/// Sends poses as datagrams, each one pago_pose_v1. Nobody need listen. [publisher thread]
class PoseSender {
 public:
  /// [set-up] `destination`: ADDRESS:PORT, IPv4. Throws Error.
  explicit PoseSender(const std::string& destination);
  ~PoseSender();
  PoseSender(const PoseSender&) = delete;
  PoseSender& operator=(const PoseSender&) = delete;

  void send(const PoseV1& pose) noexcept;
  /// Poses that the kernel did not take, e.g. because there was no route.
  std::uint64_t unsent() const noexcept { return unsent_; }

 private:
  int fd_ = -1;
  std::uint64_t unsent_ = 0;
};

/// One line of JSON, with its line feed: the fields of pago_pose_v1 by their names, health and reason in
/// words.
std::string pose_line(const PoseV1& pose);

/// Writes poses as lines of JSON, each at once. [publisher thread]
class PoseLines {
 public:
  /// [set-up] A file, or - for standard output. Throws Error if the file cannot be made.
  explicit PoseLines(const std::string& file);

  void write(const PoseV1& pose);
  /// Empty, or why lines are missing.
  std::string complaint() const;

 private:
  std::optional<TextFile> file_;  // none: standard output
  std::uint64_t unwritten_ = 0;   // lines that standard output did not take
};

}  // namespace pago::output

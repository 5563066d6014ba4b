// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace pago::output {

/// A file that is written while a run goes on. Opening it may throw; writing never does: the first failure
/// (disk full, pulled out) is kept as complaint and ends the writing. [one thread] blocks on the disk: never
/// on a real-time thread.
class TextFile {
 public:
  /// Makes the file, or empties it. Error when that cannot be done.
  explicit TextFile(std::filesystem::path path);

  void write(std::string_view bytes) noexcept;
  /// Hands everything written so far to the operating system.
  void flush() noexcept;

  /// Empty, or why the file is incomplete: "results/x/odometry.tum: cannot be written: No space left on
  /// device". Certain only after flush().
  const std::string& complaint() const noexcept { return complaint_; }
  /// Error instead of a complaint, for files that are written at one go.
  void throw_if_incomplete() const;
  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  void complain() noexcept;

  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };
  std::filesystem::path path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::string problem_, complaint_;
};

/// Makes a folder and its parents; Error when that cannot be done or a file is in the way.
void make_folders(const std::filesystem::path& folder);

/// Writes a whole file at once, for the end of a run; Error when it cannot be written.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Has `write` make the file under another name first, so that whoever reads it meets the old one or the new
/// one, whole. When `write` throws Error, nothing of the new one is left.
void replace_file(const std::filesystem::path& path,
                  const std::function<void(const std::filesystem::path& unfinished)>& write);

}  // namespace pago::output

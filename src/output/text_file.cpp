// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/text_file.hpp"

#include <cerrno>
#include <system_error>

#include "pago/core/error.hpp"

namespace pago::output {
namespace {

std::string reason(int number) {
  return std::generic_category().message(number);
}

}  // namespace

TextFile::TextFile(std::filesystem::path path) : path_(std::move(path)) {
  file_.reset(std::fopen(path_.c_str(), "wbe"));
  if (!file_)
    throw Error(path_.string(), "cannot be made: " + reason(errno), "is the folder there and writable?");
}

void TextFile::write(std::string_view bytes) noexcept {
  if (!complaint_.empty()) return;
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) complain();
}

void TextFile::flush() noexcept {
  if (!complaint_.empty()) return;
  if (std::fflush(file_.get()) != 0) complain();
}

void TextFile::complain() noexcept {
  problem_ = "cannot be written: " + reason(errno);
  complaint_ = path_.string() + ": " + problem_;
}

void TextFile::throw_if_incomplete() const {
  if (!complaint_.empty()) throw Error(path_.string(), problem_);
}

void make_folders(const std::filesystem::path& folder) {
  std::error_code fault;
  std::filesystem::create_directories(folder, fault);
  if (fault || !std::filesystem::is_directory(folder))
    throw Error(folder.string(),
                "the folder cannot be made: " + (fault ? fault.message() : "a file is in the way"),
                "choose another");
}

void write_file(const std::filesystem::path& path, std::string_view bytes) {
  TextFile file(path);
  file.write(bytes);
  file.flush();
  file.throw_if_incomplete();
}

void replace_file(const std::filesystem::path& path,
                  const std::function<void(const std::filesystem::path& unfinished)>& write) {
  const std::filesystem::path unfinished = path.string() + ".new";
  std::error_code fault;
  try {
    write(unfinished);
    std::filesystem::rename(unfinished, path, fault);
    if (fault) throw Error(path.string(), "cannot be replaced: " + fault.message());
  } catch (...) {
    std::filesystem::remove(unfinished, fault);
    throw;
  }
}

}  // namespace pago::output

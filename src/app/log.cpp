// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "log.hpp"

#include <spdlog/logger.h>
#include <spdlog/sinks/rotating_file_sink.h>
#include <spdlog/sinks/stdout_color_sinks.h>

#include "pago/core/error.hpp"

namespace pago::app {

namespace {

constexpr std::size_t kLargestFile_bytes = 5 << 20, kOlderFiles = 3;

}  // namespace

struct Log::State {
  explicit State(const std::string& file)
      : logger(
            "pago",
            {std::make_shared<spdlog::sinks::stderr_color_sink_st>(),
             std::make_shared<spdlog::sinks::rotating_file_sink_st>(file, kLargestFile_bytes, kOlderFiles)}) {
    logger.set_pattern("%Y-%m-%d %H:%M:%S.%e %^%l%$ %v");
    logger.flush_on(spdlog::level::warn);
  }
  spdlog::logger logger;
};

Log::Log(const std::filesystem::path& folder) {
  const std::string file = (folder / "log.txt").string();
  try {
    state_ = std::make_unique<State>(file);
  } catch (const spdlog::spdlog_ex& error) {
    throw Error(file, std::string("cannot be made: ") + error.what());
  }
}
Log::~Log() = default;

void Log::info(const std::string& text) {
  state_->logger.log(spdlog::level::info, text);
}
void Log::warn(const std::string& text) {
  state_->logger.log(spdlog::level::warn, text);
}
void Log::flush() {
  state_->logger.flush();
}

}  // namespace pago::app

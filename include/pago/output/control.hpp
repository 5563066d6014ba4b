// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// How a running pago is talked to: over a Unix socket, a request is one line (a word, see Request), and so
/// is its answer, a JSON object. Only the user who runs pago may connect.
namespace pago::output {

enum class Request : std::uint8_t {
  kStatus,  ///< how it goes
  kSave,    ///< everything so far to the disk
  kReset,   ///< odometry begins anew at the next sweep
  kTrace    ///< the last sweeps' stages as a trace file
};
std::optional<Request> parse_request(std::string_view line) noexcept;

/// Where a socket may lie unless told otherwise: in $XDG_RUNTIME_DIR, in /run for root, in /tmp. A run takes
/// the first; whoever asks looks in all of them, since a service has another environment than a terminal.
std::vector<std::string> usual_control_paths();
std::string default_control_path();

/// The server's side, without a thread of its own: whoever owns it asks it now and then. Clients that are
/// slow, send nonsense or too much cannot hold it up; at most eight are served at a time. [publisher thread]
class ControlServer {
 public:
  /// [set-up] Throws Error if another running process listens there, or the socket cannot be made. One that a
  /// killed process left behind is replaced.
  explicit ControlServer(std::string path);
  ~ControlServer();

  /// Answers what has been asked since the last call. `handle` gives the answer, a JSON object on one line.
  void serve(const std::function<std::string(Request)>& handle);

  const std::string& path() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The client's side: sends a line and waits for the answer, 10 s at most. Throws Error if nobody listens or
/// answers.
std::string ask(const std::string& path, const std::string& line);
/// The same in whichever of the usual places somebody listens.
std::string ask_usual(const std::string& line);

}  // namespace pago::output

// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "backlog.hpp"
#include "pago/core/stage.hpp"
#include "pago/platform/channel.hpp"

namespace pago {

/// How long a thread sleeps at most before it looks around again.
inline constexpr std::int64_t kTick_ns = 100'000'000;

template <typename T>
T pop(platform::Channel<T>& in) noexcept {
  T value{};
  while (!in.pop_wait(value, kTick_ns)) {
  }
  return value;
}

/// Waits while the channel is full. Between stages it never is: it holds more than there are sweeps.
template <typename T>
void push(platform::Channel<T>& out, const T& value) noexcept {
  while (!out.push_wait(value, kTick_ns)) {
  }
}

/// What lies between two threads: the channel, and how many complete sweeps wait in it.
template <typename T>
struct Link {
  Link(int elements, int max_pending, Recorded passed_over = {})
      : channel(static_cast<std::uint32_t>(elements)), backlog(max_pending, passed_over) {}
  platform::Channel<T> channel;
  Backlog backlog;
};

/// A thread's whole life with a stage: parts of sweeps come in, finished sweeps go out. Sweeps that the
/// backlog passes over go out untouched but for their flag: only the last thread frees. A null sweep is the
/// end of the stream and travels on behind the last one.
template <Stage S>
void run_parts(S& stage, Link<SweepPart>& in, Link<Sweep*>& out) noexcept {
  const Sweep* open = nullptr;
  bool is_passed_over = false;
  while (true) {
    const SweepPart part = pop(in.channel);
    if (part.sweep == nullptr) break;
    if (part.sweep != open) {
      open = part.sweep;
      is_passed_over = in.backlog.passes_over(part.sweep->header.sequence);
      if (!is_passed_over) stage.begin(*part.sweep);
    }
    if (!is_passed_over) stage.accept(part);
    if (!part.last) continue;
    if (is_passed_over)
      part.sweep->header.flags |= kSuperseded;
    else
      stage.finish(*part.sweep);
    open = nullptr;
    out.backlog.arrived();
    push(out.channel, part.sweep);
  }
  push(out.channel, static_cast<Sweep*>(nullptr));
}

/// The same for whole sweeps; `before(sweep)` is called ahead of each, `done(sweep)` after it, and with null
/// at the end.
template <Stage... Stages, typename Before, typename Done>
void run_sweeps(Chain<Stages...>& stages, Link<Sweep*>& in, Before before, Done done) noexcept {
  while (Sweep* sweep = pop(in.channel)) {
    before(*sweep);
    if (in.backlog.passes_over(sweep->header.sequence)) sweep->header.flags |= kSuperseded;
    stages.process(*sweep);
    done(sweep);
  }
  done(nullptr);
}

}  // namespace pago

// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

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

/// A thread's whole life with a stage: parts of sweeps come in, finished sweeps go out. A null sweep is the
/// end of the stream and travels on behind the last one.
template <Stage S>
void run_parts(S& stage, platform::Channel<SweepPart>& in, platform::Channel<Sweep*>& out) noexcept {
  const Sweep* open = nullptr;
  while (true) {
    const SweepPart part = pop(in);
    if (part.sweep == nullptr) break;
    if (part.sweep != open) stage.begin(*part.sweep);
    open = part.sweep;
    stage.accept(part);
    if (!part.last) continue;
    stage.finish(*part.sweep);
    open = nullptr;
    push(out, part.sweep);
  }
  push(out, static_cast<Sweep*>(nullptr));
}

/// The same for whole sweeps; `done(sweep)` is called with each, and with null at the end.
template <Stage... Stages, typename Done>
void run_sweeps(Chain<Stages...>& stages, platform::Channel<Sweep*>& in, Done done) noexcept {
  while (Sweep* sweep = pop(in)) {
    stages.process(*sweep);
    done(sweep);
  }
  done(nullptr);
}

}  // namespace pago

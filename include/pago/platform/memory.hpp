// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/// What a real-time program asks of the operating system for itself as a whole. For programs, not for
/// libraries that live in other people's processes: libpago never calls these. [set-up] once, before threads
/// are started.
namespace pago::platform {

/// Keeps all memory of the process, present and future, in RAM (mlockall): a page that was swapped out, or
/// never touched, costs a real-time thread milliseconds. Empty, or why it was refused and how to be allowed.
std::string lock_memory();

/// Lets freed memory stay with the process, in one arena, without mmap for large blocks (mallopt), so that
/// what was touched once never faults again; and touches `reserve_bytes` of it.
void keep_heap(std::size_t reserve_bytes);

/// Timers of the calling thread, and of threads that it starts, fire when they are due instead of up to 50 us
/// later (PR_SET_TIMERSLACK).
void make_timers_exact() noexcept;

}  // namespace pago::platform

// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pose_witness.hpp"

#include <fcntl.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <ctime>
#include <new>

#include "pago/core/error.hpp"
#include "pago/output/pose_v1.h"
#include "pago/platform/clock.hpp"

namespace pago::app {

namespace {

/// A sweep's pose, noted once.
void note(const pago_pose_slot_v1& slot, std::uint64_t& last_sequence, LatencyHistogram& latency) {
  pago_pose_v1 pose;
  if (pago_read_pose_v1(&slot, &pose) == 0 || pose.sequence == last_sequence) return;
  last_sequence = pose.sequence;
  latency.record(platform::realtime_ns() - pose.last_arrival_ns);
}

}  // namespace

PoseWitness::PoseWitness(const std::string& board) {
  void* const memory = mmap(nullptr, sizeof(Seen), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw Error("witness of poses", "no memory to share");
  seen_ = new (memory) Seen;
  child_ = fork();
  if (child_ < 0) throw Error("witness of poses", "no process can be made for it");
  if (child_ == 0) watch(board, *seen_);
}

PoseWitness::~PoseWitness() {
  stop();
  munmap(seen_, sizeof(Seen));
}

void PoseWitness::stop() {
  if (child_ < 0) return;
  kill(child_, SIGKILL);
  waitpid(child_, nullptr, 0);
  child_ = -1;
}

void PoseWitness::watch(const std::string& name, Seen& seen) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  prctl(PR_SET_TIMERSLACK, 1UL);
  const int fd = shm_open(("/" + name).c_str(), O_RDONLY, 0);
  void* const memory =
      fd < 0 ? MAP_FAILED : mmap(nullptr, sizeof(pago_pose_board_v1), PROT_READ, MAP_SHARED, fd, 0);
  if (memory == MAP_FAILED) _exit(1);
  const auto& board = *static_cast<const pago_pose_board_v1*>(memory);
  std::uint64_t last_first = UINT64_MAX, last_refined = UINT64_MAX;
  while (__atomic_load_n(&board.magic, __ATOMIC_ACQUIRE) == PAGO_POSE_V1) {
    const std::uint32_t news = __atomic_load_n(&board.news, __ATOMIC_ACQUIRE);
    note(board.first, last_first, seen.first);
    note(board.refined, last_refined, seen.refined);
    constexpr timespec kAtMost{.tv_sec = 0, .tv_nsec = 100'000'000};
    syscall(SYS_futex, &board.news, FUTEX_WAIT, news, &kAtMost, nullptr, 0);
  }
  _exit(0);
}

}  // namespace pago::app

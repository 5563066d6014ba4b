// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/pose_board.hpp"

#include <atomic>
#include <cstddef>
#include <new>

#include "pago/core/seqlock.hpp"
#include "pago/platform/clock.hpp"
#include "pago/platform/shared_memory.hpp"
#include "pago/platform/wakeup.hpp"

namespace pago::output {

namespace {

/// pago_pose_board_v1 as this side sees it.
struct Board {
  std::atomic<std::uint32_t> magic{0};
  std::atomic<std::uint32_t> news{0};
  Seqlock<PoseV1> first, refined;
};
static_assert(sizeof(PoseV1) == 464);
static_assert(sizeof(Board) == sizeof(pago_pose_board_v1));
static_assert(sizeof(Seqlock<PoseV1>) == sizeof(pago_pose_slot_v1));
static_assert(offsetof(pago_pose_board_v1, first) == offsetof(Board, first));
static_assert(offsetof(pago_pose_board_v1, refined) == offsetof(Board, refined));

}  // namespace

struct PoseBoard::State {
  explicit State(const std::string& name) : memory(name, sizeof(Board)), board(new (memory.data()) Board) {
    // Release: a reader who finds the magic finds the rest.
    board->magic.store(PAGO_POSE_V1, std::memory_order_release);
  }
  ~State() {
    board->magic.store(0, std::memory_order_release);
    board->news.fetch_add(1, std::memory_order_release);
    platform::wake_sharers(board->news);
  }

  Seqlock<PoseV1>& slot(PoseKind kind) const noexcept {
    return kind == PoseKind::kFirst ? board->first : board->refined;
  }

  platform::SharedMemory memory;
  Board* board;
};

PoseBoard::PoseBoard(const std::string& name) : state_(std::make_unique<State>(name)) {}
PoseBoard::~PoseBoard() = default;

void PoseBoard::publish(PoseV1 pose) noexcept {
  pose.published_ns = platform::realtime_ns();
  state_->slot(static_cast<PoseKind>(pose.kind)).store(pose);
  // Release: who sees the news sees the pose.
  state_->board->news.fetch_add(1, std::memory_order_release);
  platform::wake_sharers(state_->board->news);
}

bool PoseBoard::newest(PoseKind kind, PoseV1& pose) const noexcept {
  while (state_->slot(kind).count() > 0)
    if (state_->slot(kind).try_load(pose)) return true;
  return false;
}

}  // namespace pago::output

// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

#include "pago/output/pose_board.hpp"
#include "pago/output/sweep_record.hpp"
#include "pago/platform/clock.hpp"
#include "runner.hpp"

namespace pago {

/// What travels to the publisher's thread.
struct News {
  enum class Kind : std::uint8_t { kPose, kSweep, kEnd };
  Kind kind = Kind::kEnd;
  output::PoseV1 pose;         // kPose
  output::SweepRecord record;  // kSweep
};

/// The estimate thread's way to the publisher. A replay waits while it is full; live, a publisher that is
/// stuck (on a full disk, say) must not hold up the next pose: what does not fit is lost to the files, and
/// counted.
class Outlet {
 public:
  Outlet(platform::Channel<News>& news, bool waits) noexcept : news_(news), waits_(waits) {}

  void send(const News& news) noexcept {
    if (waits_ || news.kind == News::Kind::kEnd) return push(news_, news);
    if (!news_.try_push(news)) ++lost_;
  }
  /// [after the end]
  std::uint64_t lost() const noexcept { return lost_; }

 private:
  platform::Channel<News>& news_;
  bool waits_;
  std::uint64_t lost_ = 0;
};

/// Tells other processes a sweep's pose as soon as the stages before it in the chain have found it; a stage
/// itself. Without a board it does nothing.
class PublishPose {
 public:
  PublishPose(output::PoseKind kind,
              const output::PoseMaker& maker,
              output::PoseBoard* board,
              Outlet& outlet) noexcept
      : kind_(kind), maker_(maker), board_(board), outlet_(outlet) {}

  void begin(Sweep&) noexcept {}
  void accept(const SweepPart&) noexcept {}
  void finish(Sweep& sweep) noexcept {
    if (board_ == nullptr || !sweep.estimate.has_pose) return;
    News news{.kind = News::Kind::kPose, .pose = maker_.make(sweep, kind_), .record = {}};
    news.pose.published_ns = platform::realtime_ns();
    board_->publish(news.pose);
    outlet_.send(news);
  }

 private:
  output::PoseKind kind_;
  const output::PoseMaker& maker_;
  output::PoseBoard* board_;
  Outlet& outlet_;
};

}  // namespace pago

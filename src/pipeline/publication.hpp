// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

#include "pago/core/seqlock.hpp"
#include "pago/ground/ground_stage.hpp"
#include "pago/output/map_sweep.hpp"
#include "pago/output/pose_board.hpp"
#include "pago/output/sweep_record.hpp"
#include "pago/platform/clock.hpp"
#include "runner.hpp"

namespace pago {

/// What travels to the publisher's thread.
struct News {
  enum class Kind : std::uint8_t { kPose, kSweep, kMapSweep, kEnd };
  Kind kind = Kind::kEnd;
  output::PoseV1 pose;                    // kPose
  output::SweepRecord record;             // kSweep
  output::MapSweep* map_sweep = nullptr;  // kMapSweep; lent
};

/// The estimate thread's way to the publisher. A replay waits while it is full; live, a publisher that is
/// stuck (on a full disk, say) must not hold up the next pose: what does not fit is lost to the files, and
/// counted.
class Outlet {
 public:
  Outlet(platform::Channel<News>& news, bool waits) noexcept : news_(news), waits_(waits) {}

  void send(const News& news) noexcept {
    if (news.kind == News::Kind::kEnd) return push(news_, news);
    if (!try_send(news)) ++lost_;
  }
  /// False, live, if there is no room.
  bool try_send(const News& news) noexcept {
    if (!waits_) return news_.try_push(news);
    push(news_, news);
    return true;
  }
  /// [after the end]
  std::uint64_t lost() const noexcept { return lost_; }

 private:
  platform::Channel<News>& news_;
  bool waits_;
  std::uint64_t lost_ = 0;
};

/// Tells other processes a sweep's pose as soon as the stages before it in the chain have found it; a stage
/// itself. When the stream ends in a sweep, the last pose is told again, as lost. Without a board it does
/// nothing.
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
    if (board_ == nullptr) return;
    if (sweep.estimate.has_pose) {
      last_ = maker_.make(sweep, kind_);
      is_current_ = true;
      tell();
    } else if (is_current_ && sweep.header.has(kPartialEnd)) {
      last_.health = static_cast<std::uint8_t>(Health::kLost);
      last_.reason = static_cast<std::uint8_t>(HealthReason::kNoData);
      is_current_ = false;
      tell();
    }
  }

 private:
  void tell() noexcept {
    last_.published_ns = platform::realtime_ns();
    board_->publish(last_);
    outlet_.send({.kind = News::Kind::kPose, .pose = last_, .record = {}, .map_sweep = nullptr});
  }

  output::PoseKind kind_;
  const output::PoseMaker& maker_;
  output::PoseBoard* board_;
  Outlet& outlet_;
  output::PoseV1 last_{};
  bool is_current_ = false;  // nothing has ended since
};

/// Hands the verdict on the mount to the publisher's thread, once; a stage itself, behind the ground's.
class PublishMount {
 public:
  PublishMount(const ground::GroundStage& ground, Seqlock<ground::MountReport>& verdict) noexcept
      : ground_(ground), verdict_(verdict) {}

  void begin(Sweep&) noexcept {}
  void accept(const SweepPart&) noexcept {}
  void finish(Sweep&) noexcept {
    if (is_told_ || ground_.mount_report().finding == ground::MountFinding::kPending) return;
    is_told_ = true;
    verdict_.store(ground_.mount_report());
  }

 private:
  const ground::GroundStage& ground_;
  Seqlock<ground::MountReport>& verdict_;
  bool is_told_ = false;
};

}  // namespace pago

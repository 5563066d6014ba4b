// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// What the labels say, and the same with errors put in: for studies of what ground segmentation does to the
// rest. Settings in config/ground/truth.hpp. An error depends on the seed, the sweep's number and the place
// alone, so that a sweep has the same errors whatever came before.
#include <cmath>

#include "level.hpp"
#include "methods.hpp"
#include "pago/core/semantic_kitti.hpp"
#include "points.hpp"
#include "random.hpp"

namespace pago::ground {
namespace {

class Truth final : public Segmenter {
 public:
  Truth(const TruthConfig& config, const Mount& mount, std::uint32_t max_returns)
      : config_(config), level_(mount, max_returns) {
    set_height(mount.height_m);
  }

  void set_height(double height_m) noexcept override { low_z_m_ = static_cast<float>(-0.75 * height_m); }

  void finish(Sweep& sweep) noexcept override {
    const Coordinates returns = level_(sweep, 0, sweep.size);
    const bool is_labelled = sweep.header.has(kLabelled);
    for (std::uint32_t i = 0; i < sweep.size; ++i) {
      const bool is_ground = is_labelled && is_return(returns.x_m[i], returns.y_m[i], returns.z_m[i]) &&
                             is_ground_at(sweep.label[i], returns.z_m[i]);
      sweep.ground[i] = is_ground ? kGround : kNonGround;
    }
  }

 private:
  bool is_ground_at(std::uint16_t label, float z_m) const noexcept {
    const bool is_low = config_.low_vegetation && z_m < low_z_m_;
    return semantic_kitti::is_ground(label) || (label == semantic_kitti::kVegetation && is_low);
  }

  TruthConfig config_;
  float low_z_m_ = 0.0F;
  Leveller level_;
};

class TruthErrors final : public Segmenter {
 public:
  TruthErrors(const TruthConfig& truth,
              const TruthErrorsConfig& config,
              const Mount& mount,
              std::uint32_t max)
      : config_(config), truth_(truth, mount, max) {}

  void set_height(double height_m) noexcept override { truth_.set_height(height_m); }

  void finish(Sweep& sweep) noexcept override {
    truth_.finish(sweep);
    const std::uint64_t sweep_key =
        scramble(scramble(static_cast<std::uint64_t>(config_.seed)) + sweep.header.sequence);
    for (std::uint32_t i = 0; i < sweep.size; ++i)
      if (is_return(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i])) sweep.ground[i] = spoil(sweep, i, sweep_key);
  }

 private:
  // What a random number is for.
  enum Purpose : std::uint64_t { kMiss = 1, kTake = 2, kFlip = 3 };

  static bool happens(double rate, std::uint64_t key, Purpose purpose, std::uint64_t place) noexcept {
    return unit_interval(scramble(scramble(key + purpose) + place)) < rate;
  }

  std::uint8_t spoil(const Sweep& sweep, std::uint32_t i, std::uint64_t key) const noexcept {
    bool is_ground = sweep.ground[i] == kGround;
    const std::uint64_t patch = patch_of(sweep.x_m[i], sweep.y_m[i]);
    if (is_ground && happens(config_.missed_patch_rate, key, kMiss, patch)) is_ground = false;
    const bool is_plant = sweep.header.has(kLabelled) && sweep.label[i] == semantic_kitti::kVegetation;
    if (is_plant && happens(config_.taken_vegetation_rate, key, kTake, patch)) is_ground = true;
    return is_ground != happens(config_.flip_rate, key, kFlip, i) ? kGround : kNonGround;
  }

  /// Squares in the sensor's x and y, numbered; the same number again only 100,000 km away.
  std::uint64_t patch_of(float x_m, float y_m) const noexcept {
    const auto cell = [&](float metres) {
      const double number = std::floor(static_cast<double>(metres) / config_.patch_m);
      return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::fmin(std::fmax(number, -1e9), 1e9))) &
             0xFFFFFFFFU;
    };
    return cell(x_m) << 32U | cell(y_m);
  }

  TruthErrorsConfig config_;
  Truth truth_;
};

}  // namespace

std::unique_ptr<Segmenter> make_truth(const GroundConfig& config,
                                      const Mount& mount,
                                      std::uint32_t max_returns) {
  return std::make_unique<Truth>(config.truth, mount, max_returns);
}

std::unique_ptr<Segmenter> make_truth_errors(const GroundConfig& config,
                                             const Mount& mount,
                                             std::uint32_t max_returns) {
  return std::make_unique<TruthErrors>(config.truth, config.truth_errors, mount, max_returns);
}

}  // namespace pago::ground

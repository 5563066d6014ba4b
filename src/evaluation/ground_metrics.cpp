// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/ground_metrics.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "number_rows.hpp"
#include "pago/core/error.hpp"
#include "pago/core/semantic_kitti.hpp"

namespace pago::evaluation {
namespace {

enum class Truth { kGround, kNonGround, kExcluded };

Truth truth_of(GroundProtocol protocol, std::uint32_t label, bool is_low) {
  namespace classes = semantic_kitti;
  const auto name = static_cast<std::uint16_t>(label & 0xFFFFU);
  if (name == classes::kUnlabelled || name == classes::kOutlier) return Truth::kExcluded;
  if (classes::is_ground(name)) return Truth::kGround;
  if (name != classes::kVegetation) return Truth::kNonGround;
  if (protocol == GroundProtocol::kPatchworkPlusPlus) return Truth::kExcluded;
  return is_low ? Truth::kGround : Truth::kNonGround;
}

std::uint64_t& cell(GroundCounts& counts, Truth truth, bool is_claimed) {
  if (truth == Truth::kExcluded) return counts.excluded;
  if (truth == Truth::kGround) return is_claimed ? counts.true_positive : counts.false_negative;
  return is_claimed ? counts.false_positive : counts.true_negative;
}

double ratio(std::uint64_t part, std::uint64_t whole) {
  if (whole == 0) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(part) / static_cast<double>(whole);
}

constexpr double GroundScore::*kFigures[] = {&GroundScore::precision, &GroundScore::recall, &GroundScore::f1,
                                             &GroundScore::accuracy, &GroundScore::iou};

/// Over the frames where the figure is defined.
void set_mean_and_deviation(std::span<const GroundScore> scores,
                            double GroundScore::*figure,
                            GroundSummary& summary) {
  double n = 0.0, sum = 0.0, squares = 0.0;
  for (const GroundScore& score : scores) {
    if (std::isnan(score.*figure)) continue;
    n += 1.0;
    sum += score.*figure;
  }
  const double mean = sum / n;  // 0 / 0 is not defined either
  for (const GroundScore& score : scores) {
    const double difference = score.*figure - mean;
    if (!std::isnan(difference)) squares += difference * difference;
  }
  summary.mean.*figure = mean;
  summary.deviation.*figure = std::sqrt(squares / n);
}

void add(GroundCounts& sum, const GroundCounts& frame) {
  if (sum.protocol != frame.protocol)
    throw Error("ground metrics",
                "frames counted by protocol A and by protocol B cannot be summarised together");
  sum.true_positive += frame.true_positive;
  sum.false_positive += frame.false_positive;
  sum.false_negative += frame.false_negative;
  sum.true_negative += frame.true_negative;
  sum.excluded += frame.excluded;
}

}  // namespace

std::string_view to_string(GroundProtocol protocol) noexcept {
  return protocol == GroundProtocol::kPatchwork ? "A (Patchwork)" : "B (Patchwork++)";
}

GroundCounts count_ground(GroundProtocol protocol,
                          std::span<const std::uint32_t> labels,
                          std::span<const float> z_m,
                          std::span<const std::uint8_t> mask,
                          float vegetation_cut_m) {
  if (labels.size() != z_m.size() || mask.size() != z_m.size())
    throw Error("ground metrics",
                std::to_string(z_m.size()) + " points, " + std::to_string(labels.size()) +
                    " labels and a mask of " + std::to_string(mask.size()),
                "labels and mask must cover every point");
  GroundCounts counts;
  counts.protocol = protocol;
  for (std::size_t i = 0; i < z_m.size(); ++i)
    ++cell(counts, truth_of(protocol, labels[i], z_m[i] < vegetation_cut_m), mask[i] != 0);
  return counts;
}

GroundCounts count_ground(GroundProtocol protocol, const Sweep& sweep, const Mount& mount) {
  GroundCounts counts;
  counts.protocol = protocol;
  const Eigen::Vector3f up = mount.R_level_sensor().row(2).transpose().cast<float>();
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    const float z_m = up.dot(Eigen::Vector3f(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]));
    const Truth truth = truth_of(protocol, sweep.label[i], z_m < kVegetationCutMetres);
    ++cell(counts, truth, sweep.ground[i] != 0);
  }
  return counts;
}

GroundScore ground_score(const GroundCounts& c) {
  const std::uint64_t claimed_or_true = c.true_positive + c.false_positive + c.false_negative;
  GroundScore score;
  score.precision = ratio(c.true_positive, c.true_positive + c.false_positive);
  score.recall = ratio(c.true_positive, c.true_positive + c.false_negative);
  score.f1 = ratio(2 * c.true_positive, claimed_or_true + c.true_positive);
  score.accuracy = ratio(c.true_positive + c.true_negative, claimed_or_true + c.true_negative);
  score.iou = ratio(c.true_positive, claimed_or_true);
  return score;
}

GroundSummary summarize_ground(std::span<const GroundCounts> frames) {
  if (frames.empty()) throw Error("ground metrics", "no frame was counted");
  GroundSummary summary;
  summary.protocol = frames.front().protocol;
  GroundCounts sum;
  sum.protocol = summary.protocol;
  std::vector<GroundScore> scores;
  for (const GroundCounts& frame : frames) {
    add(sum, frame);
    if (frame.true_positive + frame.false_negative > 0) scores.push_back(ground_score(frame));
  }
  summary.num_frames = scores.size();
  for (const auto figure : kFigures) set_mean_and_deviation(scores, figure, summary);
  summary.pooled = ground_score(sum);
  return summary;
}

std::vector<std::uint32_t> read_semantic_labels(const std::filesystem::path& file, std::size_t num_points) {
  const std::string bytes = read_text(file);
  if (bytes.size() != 4 * num_points)
    throw Error(file.string(),
                "has " + std::to_string(bytes.size()) + " bytes, " + std::to_string(num_points) +
                    " points need " + std::to_string(4 * num_points),
                "one 32-bit label per point; is it of another scan?");
  std::vector<std::uint32_t> labels(num_points);
  for (std::size_t i = 0; i < num_points; ++i)
    for (unsigned byte = 0; byte < 4; ++byte)
      labels[i] |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[4 * i + byte])) << (8 * byte);
  return labels;
}

}  // namespace pago::evaluation

// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "heights.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <utility>

namespace pago::simulator {
namespace {

constexpr double kSamePlace_m = 8.0;  // a road's width: what is nearer is the same road or crosses it
constexpr double kAnotherVisit_m = 60.0;

/// Weights fall evenly to both sides; near an end fewer points count on both.
std::vector<double> smoothed(const std::vector<StreetPoint>& street) {
  constexpr std::size_t kReach = 6;
  std::vector<double> heights(street.size());
  for (std::size_t i = 0; i < street.size(); ++i) {
    const std::size_t reach = std::min({kReach, i, street.size() - 1 - i});
    double sum = 0.0, weights = 0.0;
    for (std::size_t k = i - reach; k <= i + reach; ++k) {
      const std::size_t apart = k > i ? k - i : i - k;
      const auto weight = static_cast<double>(reach + 1 - apart);
      sum += weight * street[k].z_m;
      weights += weight;
    }
    heights[i] = sum / weights;
  }
  return heights;
}

/// For each point the nearest one of every earlier visit to its place.
std::vector<std::pair<std::size_t, std::size_t>> meetings(const std::vector<StreetPoint>& street) {
  std::vector<std::pair<std::size_t, std::size_t>> result;
  const StreetMap map(street);
  for (std::size_t i = 0; i < street.size(); ++i) {
    const auto apart_m = [&](std::size_t j) { return (street[i].at - street[j].at).norm(); };
    std::vector<std::size_t> earlier;
    for (const std::uint32_t j : map.around(street[i].at))
      if (street[i].from_start_m - street[j].from_start_m > kAnotherVisit_m && apart_m(j) < kSamePlace_m)
        earlier.push_back(j);
    std::ranges::sort(earlier);
    for (std::size_t k = 0; k < earlier.size();) {
      std::size_t nearest = earlier[k], end = k + 1;
      while (end < earlier.size() && earlier[end] - earlier[end - 1] < 5) ++end;
      for (; k < end; ++k)
        if (apart_m(earlier[k]) < apart_m(nearest)) nearest = earlier[k];
      result.emplace_back(i, nearest);
    }
  }
  return result;
}

}  // namespace

void agree_on_heights(std::vector<StreetPoint>& street) {
  const std::vector<double> given = smoothed(street);
  const auto n = static_cast<Eigen::Index>(street.size());
  std::vector<Eigen::Triplet<double>> entries{{0, 0, 1.0}};
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  right[0] = given[0];
  const auto add_difference = [&](std::size_t from, std::size_t to, double rise_m) {
    const auto a = static_cast<Eigen::Index>(from), b = static_cast<Eigen::Index>(to);
    entries.emplace_back(a, a, 1.0);
    entries.emplace_back(b, b, 1.0);
    entries.emplace_back(a, b, -1.0);
    entries.emplace_back(b, a, -1.0);
    right[a] -= rise_m;
    right[b] += rise_m;
  };
  for (std::size_t i = 1; i < street.size(); ++i) add_difference(i - 1, i, given[i] - given[i - 1]);
  for (const auto& [i, earlier] : meetings(street)) add_difference(earlier, i, 0.0);
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::VectorXd heights = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right);
  for (std::size_t i = 0; i < street.size(); ++i) street[i].z_m = heights[static_cast<Eigen::Index>(i)];
  for (std::size_t i = 0; i < street.size(); ++i) {
    const StreetPoint &before = street[i > 0 ? i - 1 : 0],
                      &after = street[std::min(i + 1, street.size() - 1)];
    street[i].grade = (after.z_m - before.z_m) / std::max(1e-9, after.from_start_m - before.from_start_m);
  }
}

}  // namespace pago::simulator

// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/mapping/trust.hpp"

#include <limits>

#include "pago/core/se3.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::mapping;

namespace {

Vector6d along(double metres) {
  Vector6d xi = Vector6d::Zero();
  xi[0] = metres;
  return xi;
}

JointResult good(double forward_m = 0.0) {
  JointResult result;
  result.T_last_this = exp_se3(along(forward_m));
  result.information.setIdentity();
  result.matches = 1000;
  result.score = 0.6;
  return result;
}

HealthReason judge(const Trust& trust, const JointResult& result, double predicted_m = 0.0) {
  return trust.judge(result, exp_se3(along(predicted_m)), along(10.0 * predicted_m), 0.1);
}

}  // namespace

TEST_CASE("a registration near the prediction with enough matches is believed", "[mapping][trust]") {
  const Trust trust{MappingConfig{}};
  REQUIRE(judge(trust, good(1.05), 1.0) == HealthReason::kNone);
}

TEST_CASE("what makes a registration unbelievable is named", "[mapping][trust]") {
  const Trust trust{MappingConfig{}};
  JointResult few = good(), far = good(2.5), sudden = good(1.5), not_finite = good(), weak = good();
  few.matches = 99;
  not_finite.T_last_this.translation().x() = std::numeric_limits<double>::quiet_NaN();
  weak.doubted.count = 1;
  CHECK(judge(trust, few) == HealthReason::kTooFewFeatures);
  CHECK(judge(trust, far) == HealthReason::kImplausibleMotion);
  CHECK(judge(trust, sudden, 1.0) == HealthReason::kImplausibleMotion);  // 50 m/s^2
  CHECK(judge(trust, not_finite) == HealthReason::kNotFinite);
  CHECK(judge(trust, weak) == HealthReason::kNotObservable);
}

TEST_CASE("what was not observable is trusted again after half a second of being so", "[mapping][trust]") {
  Trust trust{MappingConfig{}};
  JointResult doubted = good();
  doubted.doubted.count = 1;
  trust.accept(doubted);
  for (int i = 0; i < 5; ++i) {
    REQUIRE(judge(trust, good()) == HealthReason::kNotObservable);
    trust.accept(good());
  }
  REQUIRE(judge(trust, good()) == HealthReason::kNone);
}

TEST_CASE("a poor fit is poor by what was usual before", "[mapping][trust]") {
  Trust trust{MappingConfig{}};
  JointResult half = good();
  half.score = 0.29;
  REQUIRE(judge(trust, half) == HealthReason::kNone);
  for (int i = 0; i < 5; ++i) trust.accept(good());
  REQUIRE(trust.usual_score() == Approx(0.6));
  REQUIRE(judge(trust, half) == HealthReason::kPoorFit);
  trust.restart();
  REQUIRE(judge(trust, half) == HealthReason::kNone);
}

TEST_CASE("gates widen with each failure and close with a success", "[mapping][trust]") {
  Trust trust{MappingConfig{}};
  const JointLimits at_first = trust.limits();
  REQUIRE(judge(trust, good(3.5)) == HealthReason::kImplausibleMotion);
  trust.reject();
  REQUIRE(judge(trust, good(3.5)) == HealthReason::kImplausibleMotion);  // 350 m/s^2
  REQUIRE(judge(trust, good(0.5)) == HealthReason::kNone);
  for (int i = 0; i < 3; ++i) trust.reject();
  REQUIRE(judge(trust, good(3.5)) == HealthReason::kNone);
  REQUIRE(trust.limits().gate_m > at_first.gate_m);
  REQUIRE(trust.limits().kernel_min_m > at_first.kernel_min_m);
  for (int i = 0; i < 50; ++i) trust.reject();
  REQUIRE(trust.failures() == 54);
  REQUIRE(trust.limits().gate_m <= 2.0);
  trust.accept(good());
  REQUIRE(trust.failures() == 0);
  REQUIRE(trust.limits().gate_m == at_first.gate_m);
}

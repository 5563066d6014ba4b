// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/core/stage.hpp"

#include <string>

#include "support/catch.hpp"

namespace {

/// Writes down when it is called.
struct Diarist {
  char name;
  std::string& diary;
  void begin(pago::Sweep&) noexcept { (diary += name) += "b "; }
  void accept(const pago::SweepPart& part) noexcept { (diary += name) += part.last ? "a! " : "a "; }
  void finish(pago::Sweep&) noexcept { (diary += name) += "f "; }
};

struct MayThrow {
  void begin(pago::Sweep&) {}
  void accept(const pago::SweepPart&) {}
  void finish(pago::Sweep&) {}
};
struct WithoutParts {
  void begin(pago::Sweep&) noexcept {}
  void finish(pago::Sweep&) noexcept {}
};

static_assert(pago::Stage<Diarist>);
static_assert(pago::Stage<pago::Chain<Diarist, Diarist>>, "a chain of stages is itself a stage");
static_assert(pago::Stage<pago::Chain<>>);
static_assert(!pago::Stage<MayThrow>, "a stage promises not to throw");
static_assert(!pago::Stage<WithoutParts>);

}  // namespace

TEST_CASE("a chain calls its stages in order, each verb on all before the next verb", "[core][stage]") {
  std::string diary;
  Diarist ground{'g', diary}, features{'f', diary}, odometry{'o', diary};
  pago::Chain front(ground, features);
  pago::Chain all(front, odometry);
  pago::Sweep sweep(16);
  all.begin(sweep);
  all.accept({.sweep = &sweep});
  all.accept({.sweep = &sweep, .last = true});
  all.finish(sweep);
  CHECK(diary == "gb fb ob ga fa oa ga! fa! oa! gf ff of ");
}

TEST_CASE("a chain works on the stages it was given, not on copies", "[core][stage]") {
  std::string first_diary, second_diary;
  Diarist first{'1', first_diary}, second{'2', second_diary};
  pago::Chain chain(first, second);
  pago::Sweep sweep(1);
  first.name = 'x';
  chain.finish(sweep);
  CHECK(first_diary == "xf ");
  CHECK(second_diary == "2f ");
}

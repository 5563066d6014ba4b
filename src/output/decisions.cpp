// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/decisions.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "pago/core/error.hpp"

namespace pago::output {

namespace {

constexpr std::size_t kMost = 1'000'000;

}  // namespace

void DecisionLog::add(const SweepRecord& record) {
  note_unmet_until(record.header.request);
  last_met_ = record.header.request;
  if (record.header.has(kSuperseded)) note(decisions_.superseded, record.header.sequence);
  if (record.header.has(kAfterReset)) note(decisions_.resets, record.header.sequence);
}

void DecisionLog::close(std::uint64_t requests) {
  note_unmet_until(requests + 1);
}

void DecisionLog::note_unmet_until(std::uint64_t request) {
  for (std::uint64_t unmet = last_met_ + 1; unmet < request && is_complete_; ++unmet)
    note(decisions_.unmet, unmet);
}

void DecisionLog::note(std::vector<std::uint64_t>& list, std::uint64_t number) {
  is_complete_ = is_complete_ && list.size() < kMost;
  if (is_complete_) list.push_back(number);
}

Decisions read_decisions(const std::filesystem::path& run_json) {
  const std::string name = run_json.string();
  std::ifstream in(run_json);
  if (!in) throw Error(name, "cannot be opened", "give the run.json of a live run");
  const auto json = nlohmann::json::parse(in, nullptr, /*allow_exceptions=*/false);
  const auto found = json.is_object() ? json.find("decisions") : json.end();
  if (json.is_discarded() || found == json.end())
    throw Error(name, "is no run.json of PaGO", "give the run.json of a live run");
  try {
    if (!found->at("complete").get<bool>())
      throw Error(
          name, "does not know all that the clock decided",
          "a run that was saved before its end, or whose files miss sweeps, cannot be replayed as recorded");
    Decisions decisions;
    found->at("superseded").get_to(decisions.superseded);
    found->at("unmet").get_to(decisions.unmet);
    found->at("resets").get_to(decisions.resets);
    if (const auto trajectory = json.find("trajectory"); trajectory != json.end())
      trajectory->at("hash").get_to(decisions.hash);
    return decisions;
  } catch (const nlohmann::json::exception& error) {
    throw Error(name, std::string("its decisions are damaged: ") + error.what());
  }
}

}  // namespace pago::output

// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/run_files.hpp"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "pago/core/csv.hpp"
#include "pago/core/error.hpp"

namespace pago::output {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double kNsPerMs = 1e6;

/// Columns of a duration; a cell may be empty.
std::optional<std::int64_t> ns_at(const CsvTable& table, std::size_t row, std::optional<std::size_t> column) {
  if (!column || table.text(row, *column).empty()) return std::nullopt;
  return std::llround(table.number(row, *column) * kNsPerMs);
}

struct StageColumns {
  std::optional<std::size_t> wait, run, cpu;
};

StageSplit split_at(const CsvTable& table, std::size_t row, const StageColumns& columns) {
  StageSplit split;
  const auto run_ns = ns_at(table, row, columns.run);
  split.ran = run_ns.has_value();
  split.run_ns = run_ns.value_or(0);
  split.wait_ns = ns_at(table, row, columns.wait).value_or(0);
  split.cpu_ns = ns_at(table, row, columns.cpu).value_or(0);
  return split;
}

Json parse_json(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error(file.string(), "cannot be opened", "does it exist, may it be read?");
  try {
    return Json::parse(stream);
  } catch (const Json::exception&) {
    throw Error(file.string(), "is not JSON", "was the run cut off while it wrote it?");
  }
}

template <typename Value>
Value value_of(const Json& json, const char* key, Value otherwise) {
  const auto found = json.find(key);
  return found == json.end() || found->is_null() ? otherwise : found->get<Value>();
}

/// The whole numbers of an object, and of objects in it ("dropped: superseded").
RunFacts::Counts counts_of(const Json& json, const std::string& prefix = {}) {
  RunFacts::Counts counts;
  if (!json.is_object()) return counts;
  for (const auto& [name, value] : json.items()) {
    if (value.is_number_unsigned()) counts.emplace_back(prefix + name, value.get<std::uint64_t>());
    if (!value.is_object()) continue;
    for (auto& count : counts_of(value, name + ": ")) counts.push_back(std::move(count));
  }
  return counts;
}

std::vector<std::pair<std::string, std::string>> facts_of(const Json& json) {
  std::vector<std::pair<std::string, std::string>> facts;
  for (const auto& [name, value] : json.items()) {
    if (value.is_string()) facts.emplace_back(name, value.get<std::string>());
    if (!value.is_array()) continue;
    for (const auto& item : value) facts.emplace_back(name, item.get<std::string>());
  }
  return facts;
}

RunFacts facts_from(const Json& json) {
  const Json none = Json::object();
  const auto part = [&](const char* key) -> const Json& {
    const auto found = json.find(key);
    return found != json.end() && found->is_object() ? *found : none;
  };
  RunFacts facts;
  facts.version = value_of<std::string>(json, "version", "");
  facts.source = value_of<std::string>(json, "source", "");
  facts.complaint = value_of<std::string>(json, "complaint", "");
  facts.config_toml = value_of<std::string>(json, "config", "");
  facts.is_live = value_of(json, "live", false);
  facts.wall_s = value_of(json, "wall_s", 0.0);
  facts.hash = value_of<std::string>(part("trajectory"), "hash", "");
  facts.length_m = value_of(part("trajectory"), "length_m", 0.0);
  facts.poses = value_of<std::uint64_t>(part("trajectory"), "poses", 0);
  facts.facts = facts_of(part("facts"));
  facts.sweeps = counts_of(part("sweeps"));
  facts.packets = counts_of(part("packets"));
  facts.firings = counts_of(part("firings"));
  const auto health = part("trajectory").find("health");
  if (health != part("trajectory").end()) facts.health = counts_of(*health);
  return facts;
}

}  // namespace

std::vector<LatencyRow> read_latency_csv(const fs::path& file) {
  const CsvTable table = CsvTable::read(file);
  std::array<StageColumns, kNumStages> columns;
  for (std::size_t i = 0; i < kNumStages; ++i) {
    const std::string name(stage_name(static_cast<StageId>(i)));
    columns[i] = {table.find(name + "_wait_ms"), table.find(name + "_run_ms"), table.find(name + "_cpu_ms")};
  }
  const std::size_t sequence = table.at("sequence"), stamp = table.at("stamp_ns");
  const auto first = table.find("first_pose_ms"), refined = table.find("refined_pose_ms");
  std::vector<LatencyRow> rows(table.num_rows());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    rows[row].sequence = table.count(row, sequence);
    rows[row].stamp_ns = table.integer(row, stamp);
    for (std::size_t i = 0; i < kNumStages; ++i) rows[row].stages[i] = split_at(table, row, columns[i]);
    rows[row].first_pose_ns = ns_at(table, row, first).value_or(-1);
    rows[row].refined_pose_ns = ns_at(table, row, refined).value_or(-1);
  }
  return rows;
}

std::uint64_t RunFacts::dropped_sweeps() const noexcept {
  std::uint64_t dropped = 0;
  for (const auto& [name, count] : sweeps)
    if (name.starts_with("dropped: ")) dropped += count;
  return dropped;
}

RunFacts read_run_json(const fs::path& file) {
  const Json json = parse_json(file);
  try {
    return facts_from(json);
  } catch (const Json::exception&) {
    throw Error(file.string(), "is not the run.json of a run");
  }
}

bool is_results_folder(const fs::path& folder) {
  return fs::exists(folder / "run.json") || fs::exists(folder / "latency.csv");
}

RunFiles read_run_files(const fs::path& folder) {
  if (!is_results_folder(folder))
    throw Error(folder.string(), "is not the results folder of a run",
                "it has neither run.json nor latency.csv");
  RunFiles files;
  files.folder = folder;
  if (fs::exists(folder / "run.json")) files.facts = read_run_json(folder / "run.json");
  if (fs::exists(folder / "latency.csv")) files.latency = read_latency_csv(folder / "latency.csv");
  if (fs::exists(folder / "poses.csv")) files.poses = read_poses_csv(folder / "poses.csv");
  return files;
}

}  // namespace pago::output

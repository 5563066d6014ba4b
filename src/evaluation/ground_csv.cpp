// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/ground_csv.hpp"

#include <algorithm>
#include <cinttypes>

#include "pago/core/csv.hpp"
#include "pago/core/error.hpp"
#include "pago/core/text.hpp"

namespace pago::evaluation {
namespace {

GroundProtocol protocol_at(const CsvTable& table, std::size_t row, std::size_t column) {
  const std::string& letter = table.text(row, column);
  if (letter == "A") return GroundProtocol::kPatchwork;
  if (letter == "B") return GroundProtocol::kPatchworkPlusPlus;
  throw Error(table.name() + ":" + std::to_string(row + 2), "protocol is \"" + letter + "\", not A or B");
}

}  // namespace

std::string_view ground_csv_header() noexcept {
  return "frame,method,protocol,tp,fp,fn,tn";
}

std::string ground_csv_line(const GroundRow& row) {
  const GroundCounts& c = row.counts;
  return format("%" PRIu64 ",", row.frame) + row.method +
         (c.protocol == GroundProtocol::kPatchwork ? ",A" : ",B") +
         format(",%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%" PRIu64, c.true_positive, c.false_positive,
                c.false_negative, c.true_negative);
}

std::vector<GroundRow> read_ground_csv(const std::filesystem::path& file) {
  const CsvTable table = CsvTable::read(file);
  const std::size_t frame = table.at("frame"), protocol = table.at("protocol");
  const std::size_t tp = table.at("tp"), fp = table.at("fp"), fn = table.at("fn"), tn = table.at("tn");
  const auto method = table.find("method");
  std::vector<GroundRow> rows(table.num_rows());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].frame = table.count(i, frame);
    if (method) rows[i].method = table.text(i, *method);
    rows[i].counts = {protocol_at(table, i, protocol),
                      table.count(i, tp),
                      table.count(i, fp),
                      table.count(i, fn),
                      table.count(i, tn),
                      0};
  }
  return rows;
}

std::vector<GroundSeries> ground_series(const std::vector<GroundRow>& rows) {
  std::vector<GroundSeries> all;
  for (const GroundRow& row : rows) {
    const auto is_same = [&](const GroundSeries& s) {
      return s.method == row.method && s.protocol == row.counts.protocol;
    };
    auto found = std::find_if(all.begin(), all.end(), is_same);
    if (found == all.end()) {
      all.push_back({row.method, row.counts.protocol, {}, {}});
      found = std::prev(all.end());
    }
    found->frames.push_back(row.frame);
    found->counts.push_back(row.counts);
  }
  return all;
}

}  // namespace pago::evaluation

// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/stream_survey.hpp"

#include "assembly/ingest_rig.hpp"
#include "support/catch.hpp"
#include "support/status_cycle.hpp"

using namespace pago;
using namespace pago::test;

namespace {

constexpr std::uint32_t kSensor = 0xC0A8032B, kOther = 0xC0A8032C;

hdl64::Calibration some_unit(double distance_m) {
  hdl64::Calibration unit = plain_calibration();
  for (std::size_t i = 0; i < unit.lasers.size(); ++i) {
    unit.lasers[i].vertical_rad = (static_cast<double>(i) - 50.0) * 0.007;
    unit.lasers[i].distance_m = unit.lasers[i].distance_x_m = unit.lasers[i].distance_y_m = distance_m;
    unit.lasers[i].max_intensity = 255;
  }
  return unit;
}

/// Packets [0, count) of a sensor that sends `unit`.
void survey_stream(StreamSurvey& survey, const hdl64::Calibration& unit, int count) {
  const PacketStream stream;
  const StatusCycle cycle = make_status_cycle(unit);
  for (int i = 0; i < count; ++i) {
    PacketBytes bytes = stream.packet(i);
    const StatusByte& said = cycle[static_cast<std::size_t>(i) % cycle.size()];
    bytes[1204] = said.type, bytes[1205] = said.value;
    survey.add({.payload = bytes,
                .arrival_ns = stream.arrival_ns(i),
                .source_ipv4 = kSensor,
                .source_port = 443,
                .destination_port = 2368});
  }
}

constexpr int kRound = static_cast<int>(hdl64::StatusReader::kRoundPackets);

}  // namespace

TEST_CASE("a survey tells who sends, and which of them is a sensor", "[assembly][survey]") {
  StreamSurvey survey;
  survey_stream(survey, some_unit(1.2), 200);
  const std::array<std::uint8_t, 512> position{};
  for (int i = 0; i < 5; ++i)
    survey.note_sender(
        {.payload = position, .arrival_ns = i, .source_ipv4 = kOther, .destination_port = 8308});
  survey.finish();
  const std::vector<Sender> senders = survey.senders();
  REQUIRE(senders.size() == 2);
  CHECK(senders[0].ipv4 == kSensor);
  CHECK(senders[0].port == 443);
  CHECK(senders[0].datagrams == 200);
  CHECK(senders[0].packets == 200);
  CHECK(senders[0].sensor == hdl64::SensorKind::kHdl64Single);
  CHECK(senders[1].ipv4 == kOther);
  CHECK(senders[1].destination_port == 8308);
  CHECK(senders[1].datagrams == 5);
  CHECK(senders[1].packets == 0);
  CHECK(senders[1].sensor == hdl64::SensorKind::kUnknown);
  CHECK(survey.ingest().packets().decoded == 200);
}

TEST_CASE("a survey finds the sensor's own calibration", "[assembly][survey]") {
  StreamSurvey survey;
  survey_stream(survey, some_unit(1.2), kRound / 2);
  CHECK_FALSE(survey.calibration().has_value());
  StreamSurvey longer;
  survey_stream(longer, some_unit(1.2), kRound + 100);
  REQUIRE(longer.calibration().has_value());
  CHECK(longer.calibration()->lasers[7].distance_m == Approx(1.2));
  CHECK(longer.complaint().empty());
}

TEST_CASE("a survey complains of another unit's file, and of no other", "[assembly][survey]") {
  hdl64::Calibration file = some_unit(1.2);
  file.origin = "db.xml";
  StreamSurvey right({}, file);
  survey_stream(right, some_unit(1.2), kRound + 100);
  CHECK(right.complaint().empty());
  StreamSurvey wrong({}, file);
  survey_stream(wrong, some_unit(1.3), kRound + 100);
  CHECK(wrong.complaint().find("wrong calibration: db.xml") == 0);
  CHECK(wrong.complaint().find("0.100 m") != std::string::npos);
}

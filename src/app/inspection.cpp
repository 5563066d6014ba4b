// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "inspection.hpp"

#include <nlohmann/json.hpp>

#include "pago/config/packet_filter.hpp"
#include "pago/core/text.hpp"

namespace pago::app {

namespace {

using hdl64::Checksum;
using hdl64::SensorKind;
using Json = nlohmann::ordered_json;

unsigned long long number(std::uint64_t n) {
  return n;
}

/// One line of the screen: a name, then what is to be said.
std::string line(const char* name, const std::string& text) {
  return format("%-12s %s\n", name, text.c_str());
}

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

std::string checksum_words(Checksum checksum) {
  switch (checksum) {
    case Checksum::kCrc:
      return "CRC-16 right";
    case Checksum::kLength:
      return "length word right, two rounds agree";
    case Checksum::kAgreed:
      return "no checksum that is known, three rounds agree";
    case Checksum::kNone:
      break;
  }
  return "incomplete";
}

std::string sensor_line(const PacketIngest& ingest) {
  const hdl64::SensorStatus& said = ingest.status().status();
  std::string text = model_of(ingest);
  if (const std::string firmware = hdl64::firmware_of(said); !firmware.empty())
    text += ", firmware " + firmware;
  if (ingest.sender().ipv4() != 0)
    text += ", at " + ipv4_text(ingest.sender().ipv4()) + ":" + std::to_string(ingest.sender().port());
  return text;
}

std::string rate_line(const PacketIngest& ingest) {
  const hdl64::StreamFormat& format_found = ingest.format();
  const double period_us = 1e-3 * static_cast<double>(format_found.firing_period_ns);
  return format("%.1f per second, %d firings each, one every %.1f us",
                1e9 / static_cast<double>(format_found.packet_period_ns()), format_found.firings(),
                period_us);
}

std::string rotation_line(const PacketIngest& ingest) {
  if (ingest.rotation_hz() == 0.0) return "the head does not turn";
  const hdl64::SensorStatus& said = ingest.status().status();
  std::string text = format(
      "%.3f per second (%.0f rpm), %.0f firings each", ingest.rotation_hz(), 60.0 * ingest.rotation_hz(),
      1e9 / ingest.rotation_hz() / static_cast<double>(ingest.format().firing_period_ns));
  if (said.motor_rpm != 0) text += format(", set to %d rpm", said.motor_rpm);
  if (ingest.is_view_limited()) text += "; field of view limited";
  return text;
}

std::string calibration_lines(const Inspection& found) {
  const hdl64::StatusReader& status = found.survey.ingest().status();
  std::string own = "none in the stream";
  if (status.has_calibration()) {
    const auto& date = status.status().calibrated;
    own = "in the stream (" + checksum_words(status.checksum()) +
          format("), made 20%02d-%02d-%02d", date[0], date[1], date[2]);
  } else if (status.progress() > 0.0 && found.survey.ingest().format().has_stamps()) {
    own = "none whole in the stream";
  }
  std::string text = line("calibration", own);
  if (!found.calibration) return text;
  text +=
      line("", found.calibration->origin + (found.calibration->two_point ? ", two-point" : ", one-point"));
  if (const auto& d = found.survey.ingest().calibration_difference(); d)
    text += line("", (d->is_other_unit() ? "NOT this unit's: " : "this unit's: ") +
                         format("differs by %.3f deg vertical, %.3f deg rotation, %.4f m distance (means; "
                                "at most %.2f deg)",
                                d->vertical_deg, d->rotation_deg, d->distance_m,
                                std::max(d->max_vertical_deg, d->max_rotation_deg)));
  return text;
}

std::string clock_line(const PacketIngest& ingest) {
  if (!ingest.format().has_stamps()) return "no time stamps: the host's time is used";
  return "GPS: " + std::string(to_string(ingest.status().status().gps)) +
         format("; host's clock %+.1f ppm against it", ingest.clock_offset().drift_ppm()) +
         (ingest.clock_restarts() > 0 ? format(", began anew %llu times", number(ingest.clock_restarts()))
                                      : "");
}

std::string health_line(const PacketIngest& ingest) {
  const hdl64::SensorStatus& said = ingest.status().status();
  if (!ingest.format().has_stamps()) return "not told by this model";
  const std::vector<std::string> warnings = hdl64::warnings_of(said);
  return format("%d C, ", said.temperature_c) + (warnings.empty() ? "no warnings" : joined(warnings, ", ")) +
         (said.life_hours > 0 ? format(", %d hours in use", said.life_hours) : "");
}

std::string loss_lines(const Inspection& found) {
  const PacketIngest& ingest = found.survey.ingest();
  const FiringCounters firings = ingest.firings();
  const PacketCounters packets = ingest.packets();
  const double share = firings.expected == 0 ? 0.0
                                             : 100.0 * static_cast<double>(firings.lost) /
                                                   static_cast<double>(firings.expected - firings.blind);
  return line("losses", format("%llu of %llu firings (%.3f %%)", number(firings.lost),
                               number(firings.expected - firings.blind), share)) +
         line("", format("packets: %llu used, %llu bad, %llu duplicate, %llu late, %llu reordered",
                         number(packets.decoded), number(packets.bad_total()), number(packets.duplicate),
                         number(packets.late), number(packets.reordered))) +
         line("", format("datagrams: %llu filtered, %llu cut or damaged", number(found.counters.filtered),
                         number(found.counters.bad())));
}

std::string sender_lines(const StreamSurvey& survey) {
  const std::vector<Sender> senders = survey.senders();
  const bool is_told_above = senders.size() == 1 && survey.ingest().packets().received > 0;
  if (is_told_above) return {};
  std::string text;
  constexpr std::size_t kMost = 8;
  for (std::size_t i = 0; i < std::min(senders.size(), kMost); ++i) {
    const Sender& s = senders[i];
    const bool is_used = survey.ingest().packets().decoded > 0 && s.ipv4 == survey.ingest().sender().ipv4() &&
                         s.port == survey.ingest().sender().port();
    const std::string from = s.ipv4 == 0 ? "unknown" : ipv4_text(s.ipv4);
    text += line(
        i == 0 ? "senders" : "",
        from + format(":%u to port %u: %llu datagrams, ", s.port, s.destination_port, number(s.datagrams)) +
            std::string(s.sensor == SensorKind::kUnknown ? "no sensor that is known" : name(s.sensor)) +
            (is_used ? " (used)" : ""));
  }
  if (senders.size() > kMost) text += line("", format("and %zu more", senders.size() - kMost));
  return text;
}

Json calibration_json(const Inspection& found) {
  const hdl64::StatusReader& status = found.survey.ingest().status();
  Json json = {{"in_stream", status.has_calibration()},
               {"checksum", checksum_words(status.checksum())},
               {"file", found.calibration ? Json(found.calibration->origin) : Json()},
               {"vertical_offset",
                found.config.vertical_offset == VerticalOffset::kVertical ? "vertical" : "perpendicular"}};
  if (const auto& d = found.survey.ingest().calibration_difference(); found.calibration && d)
    json["difference"] = {{"is_other_unit", d->is_other_unit()},
                          {"vertical_deg", d->vertical_deg},
                          {"rotation_deg", d->rotation_deg},
                          {"distance_m", d->distance_m}};
  return json;
}

Json senders_json(const StreamSurvey& survey) {
  Json list = Json::array();
  for (const Sender& s : survey.senders())
    list.push_back({{"address", s.ipv4 == 0 ? Json() : Json(ipv4_text(s.ipv4))},
                    {"port", s.port},
                    {"destination_port", s.destination_port},
                    {"datagrams", s.datagrams},
                    {"sensor", name(s.sensor)}});
  return list;
}

}  // namespace

std::string model_of(const PacketIngest& ingest) {
  const hdl64::StatusReader& status = ingest.status();
  const bool is_s3 = status.checksum() == Checksum::kCrc || ingest.format().is_dual() ||
                     ingest.format().firing_period_ns == hdl64::kFiringPeriodS3_ns;
  switch (ingest.sensor()) {
    case SensorKind::kHdl64Single:
      return std::string(is_s3                                    ? "HDL-64E S3"
                         : status.checksum() == Checksum::kLength ? "HDL-64E S2.1"
                                                                  : "HDL-64E S2, S2.1 or S3") +
             ", single return" +
             (status.status().return_mode == hdl64::ReturnMode::kUnknown
                  ? ""
                  : " (" + std::string(to_string(status.status().return_mode)) + ")");
    case SensorKind::kHdl64Dual:
      return "HDL-64E S3, dual return";
    default:
      return std::string(name(ingest.sensor()));
  }
}

std::string inspection_text(const Inspection& found) {
  const PacketIngest& ingest = found.survey.ingest();
  const bool is_vertical = found.config.vertical_offset == VerticalOffset::kVertical;
  std::string text = line("source", found.source + format(", %.1f s, %llu datagrams", found.seconds,
                                                          number(found.counters.delivered)));
  if (ingest.packets().decoded > 0) {
    text += line("sensor", sensor_line(ingest)) + line("packets", rate_line(ingest)) +
            line("rotation", rotation_line(ingest)) + calibration_lines(found) +
            line("vert offset", std::string("read as ") + (is_vertical ? "vertical" : "perpendicular") +
                                    " (hdl64.vertical_offset); no unit or file says which is right") +
            line("clock", clock_line(ingest)) + line("health", health_line(ingest)) + loss_lines(found);
  } else {
    text += line("sensor", ingest.packets().received == 0 ? "none" : ingest.refusal());
  }
  text += sender_lines(found.survey);
  if (!found.complaint.empty()) text += line("complaint", found.complaint);
  return text;
}

std::string inspection_json(const Inspection& found) {
  const PacketIngest& ingest = found.survey.ingest();
  const hdl64::SensorStatus& said = ingest.status().status();
  const FiringCounters firings = ingest.firings();
  const PacketCounters packets = ingest.packets();
  const Json json = {{"source", found.source},
                     {"seconds", found.seconds},
                     {"sensor", model_of(ingest)},
                     {"refusal", ingest.refusal()},
                     {"firmware", hdl64::firmware_of(said)},
                     {"return_mode", ingest.format().is_dual() ? "both" : to_string(said.return_mode)},
                     {"packets_per_s", 1e9 / static_cast<double>(ingest.format().packet_period_ns())},
                     {"firing_period_us", 1e-3 * static_cast<double>(ingest.format().firing_period_ns)},
                     {"rotation_hz", ingest.rotation_hz()},
                     {"view_limited", ingest.is_view_limited()},
                     {"calibration", calibration_json(found)},
                     {"clock",
                      {{"gps", to_string(said.gps)},
                       {"drift_ppm", ingest.clock_offset().drift_ppm()},
                       {"restarts", ingest.clock_restarts()}}},
                     {"health",
                      {{"temperature_c", said.temperature_c},
                       {"warnings", hdl64::warnings_of(said)},
                       {"hours", said.life_hours},
                       {"power_level", said.power_level}}},
                     {"firings",
                      {{"expected", firings.expected},
                       {"decoded", firings.decoded},
                       {"lost", firings.lost},
                       {"blind", firings.blind}}},
                     {"packets",
                      {{"received", packets.received},
                       {"decoded", packets.decoded},
                       {"bad", packets.bad_total()},
                       {"duplicate", packets.duplicate},
                       {"late", packets.late},
                       {"reordered", packets.reordered},
                       {"filtered", packets.filtered}}},
                     {"datagrams",
                      {{"received", found.counters.received},
                       {"delivered", found.counters.delivered},
                       {"filtered", found.counters.filtered},
                       {"bad", found.counters.bad()}}},
                     {"senders", senders_json(found.survey)},
                     {"complaint", found.complaint}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace pago::app

// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "live_observer.hpp"

#include <nlohmann/json.hpp>

#include "pago/core/error.hpp"
#include "pago/core/text.hpp"
#include "pago/core/units.hpp"
#include "pago/platform/clock.hpp"

namespace pago::app {

namespace {

constexpr std::chrono::seconds kBetweenLosses{1};

/// One line; paths in it need not be UTF-8.
std::string line_of(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::uint64_t no_free_sweep(const IngestStatus& status) {
  return status.sweeps.no_free_sweep;
}

/// "12 datagrams by the kernel (receive buffer full), 30 firings of 1,200": what was lost between two
/// moments.
std::string losses(const IngestStatus& before, const IngestStatus& now, std::uint64_t superseded) {
  std::string text;
  const auto add = [&text](std::uint64_t count, const char* what) {
    if (count != 0)
      text += format("%s%llu %s", text.empty() ? "" : ", ", static_cast<unsigned long long>(count), what);
  };
  add(now.source.kernel_dropped - before.source.kernel_dropped,
      "datagrams by the kernel (receive buffer full)");
  add(now.source.bad() - before.source.bad(), "datagrams cut short");
  add(now.packets.bad_total() - before.packets.bad_total(), "damaged or foreign packets");
  add(now.packets.late - before.packets.late, "late packets");
  add(now.packets.duplicate - before.packets.duplicate, "duplicate packets");
  add(now.firings.lost - before.firings.lost, "firings that never arrived");
  add(no_free_sweep(now) - no_free_sweep(before), "sweeps (no free sweep: the consumer is stalled)");
  add(superseded, "sweeps (superseded by newer ones)");
  return text;
}

}  // namespace

LiveOutlets open_outlets(const Config& config) {
  LiveOutlets outlets;
  const std::string& socket = config.control.socket;
  if (!config.publish.udp.empty()) outlets.sender = std::make_unique<output::PoseSender>(config.publish.udp);
  if (!config.publish.json_lines.empty())
    outlets.lines = std::make_unique<output::PoseLines>(config.publish.json_lines);
  if (socket != "none")
    outlets.control =
        std::make_unique<output::ControlServer>(socket.empty() ? output::default_control_path() : socket);
  if (!config.record.file.empty()) outlets.packets = std::make_unique<PcapRecorder>(config.record);
  return outlets;
}

LiveObserver::LiveObserver(LiveOutlets& outlets,
                           std::string source,
                           const Mount& mount,
                           output::RunRecorder& recorder,
                           std::function<output::RunReport(const IngestStatus&)> report_so_far,
                           std::function<void()> reset)
    : outlets_(outlets),
      source_(std::move(source)),
      mount_(mount),
      recorder_(recorder),
      report_so_far_(std::move(report_so_far)),
      reset_(std::move(reset)),
      log_(recorder.folder()) {}

void LiveObserver::on_sweep(const output::SweepRecord& record) {
  recorder_.add(record);
  line_.count(record);
  superseded_ += record.header.has(kSuperseded) ? 1U : 0U;
  if (!record.has_pose || record.health == health_) return;
  health_ = record.health;
  line_.clear();
  const std::string reason(to_string(record.reason));
  log_.info(format("sweep %llu: health ", static_cast<unsigned long long>(record.header.sequence)) +
            std::string(to_string(health_)) + (reason.empty() ? "" : " (" + reason + ")"));
}

void LiveObserver::on_pose(const output::PoseV1& pose) {
  if (outlets_.sender) outlets_.sender->send(pose);
  if (pose.kind != PAGO_POSE_REFINED) return;
  newest_ = pose;
  if (outlets_.lines) outlets_.lines->write(pose);
}

void LiveObserver::on_mount(const ground::MountReport& report) {
  if (!report.is_warning()) return;
  line_.clear();
  log_.warn(to_text(report, mount_));
}

void LiveObserver::on_status(const IngestStatus& status) {
  now_ = status;
  line_.show(status.progress);
  note_state();
  note_sensor();
  if (Clock::now() >= next_losses_) note_losses();
  if (outlets_.control) outlets_.control->serve([this](output::Request request) { return handle(request); });
}

void LiveObserver::note_state() {
  const StreamState state = stream_state(now_, platform::monotonic_ns());
  // A process that starts before its sensor says so once it is clear that nothing comes.
  const bool is_early = state == StreamState::kNoData && Clock::now() - start_ < std::chrono::seconds(1);
  const bool is_known = state != StreamState::kRunning || now_.sensor != hdl64::SensorKind::kUnknown;
  if (state == state_ || is_early || !is_known) return;
  state_ = state;
  line_.clear();
  const std::string sentence = explain(state, now_, source_);
  if (state == StreamState::kRunning)
    log_.info(sentence);
  else
    log_.warn(sentence);
}

void LiveObserver::note_sensor() {
  for (const std::string& warning : hdl64::warnings_of(now_.said)) {
    if (!told_warnings_.insert(warning).second) continue;
    line_.clear();
    log_.warn("the sensor says: " + warning);
  }
  if (!now_.is_calibration_wrong || !told_warnings_.insert("calibration").second) return;
  line_.clear();
  log_.warn("wrong calibration: it is not the one that this sensor sends; `pago inspect` shows by how much");
}

void LiveObserver::note_losses() {
  next_losses_ = Clock::now() + kBetweenLosses;
  std::string text = losses(told_, now_, superseded_ - told_superseded_);
  const std::uint64_t unwritten = outlets_.packets ? outlets_.packets->counters().unwritten() : 0;
  if (unwritten > told_unwritten_)
    text += format("%s%llu datagrams to the recording (disk full or slow)", text.empty() ? "" : ", ",
                   static_cast<unsigned long long>(unwritten - told_unwritten_));
  told_unwritten_ = unwritten;
  told_ = now_;
  told_superseded_ = superseded_;
  if (text.empty()) return;
  line_.clear();
  log_.warn("lost in the last second: " + text);
}

std::string LiveObserver::handle(output::Request request) {
  switch (request) {
    case output::Request::kStatus:
      return status_json();
    case output::Request::kSave:
      recorder_.finish(report_so_far_(now_));
      break;
    case output::Request::kReset:
      reset_();
      log_.info("reset: odometry begins anew");
      break;
    case output::Request::kTrace: {
      const std::string file = recorder_.save_trace();
      if (file.empty()) return R"({"error": "no trace: output.trace_sweeps is 0, or no sweep has come yet"})";
      return line_of({{"trace", file}});
    }
  }
  const std::vector<std::string> complaints = recorder_.complaints();
  if (!complaints.empty()) return line_of({{"error", complaints.front()}});
  return line_of({{"folder", recorder_.folder().string()}});
}

std::string LiveObserver::status_json() const {
  const output::LatencySummary first = output::summarize(recorder_.totals().latency.first_pose);
  const StreamState state = stream_state(now_, platform::monotonic_ns());
  const nlohmann::ordered_json json = {
      {"state", to_string(state)},
      {"explanation", explain(state, now_, source_)},
      {"health", to_string(static_cast<Health>(newest_.health))},
      {"reason", to_string(static_cast<HealthReason>(newest_.reason))},
      {"uptime_s", std::chrono::duration<double>(Clock::now() - start_).count()},
      {"rotation_hz", state == StreamState::kRunning ? now_.rotation_hz : 0.0},
      {"sensor",
       {{"temperature_c", now_.said.temperature_c},
        {"warnings", hdl64::warnings_of(now_.said)},
        {"firmware", hdl64::firmware_of(now_.said)},
        {"gps", to_string(now_.said.gps)},
        {"clock_drift_ppm", now_.clock_drift_ppm},
        {"calibration_is_its_own", !now_.is_calibration_wrong}}},
      {"poses", recorder_.totals().num_poses},
      {"length_m", recorder_.totals().length_m},
      {"position_m", newest_.position_m},
      {"orientation_xyzw", newest_.orientation_xyzw},
      {"first_pose_ms",
       {{"p50", milliseconds(first.p50_ns)},
        {"p99", milliseconds(first.p99_ns)},
        {"max", milliseconds(first.max_ns)}}},
      {"packets", {{"received", now_.packets.received}, {"decoded", now_.packets.decoded}}},
      {"lost", losses({}, now_, superseded_)},
      {"folder", recorder_.folder().string()}};
  return line_of(json);
}

std::vector<std::string> LiveObserver::complaints() const {
  std::vector<std::string> result;
  if (outlets_.lines && !outlets_.lines->complaint().empty()) result.push_back(outlets_.lines->complaint());
  if (outlets_.packets && !outlets_.packets->complaint().empty())
    result.push_back(outlets_.packets->complaint());
  if (outlets_.sender && outlets_.sender->unsent() > 0)
    result.push_back(format("%llu poses could not be sent by UDP: no route?",
                            static_cast<unsigned long long>(outlets_.sender->unsent())));
  return result;
}

}  // namespace pago::app

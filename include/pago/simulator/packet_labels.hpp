// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "pago/core/sweep.hpp"
#include "pago/hdl64/calibration.hpp"
#include "pago/output/text_file.hpp"
#include "pago/simulator/simulator.hpp"

namespace pago::simulator {

/// What a packet's slots returned from, one byte each: a place in a table of classes, which is enough for all
/// that the worlds hold. Firing 0 of the packet begins at `time_ns`.
struct PacketLabels {
  std::int64_t time_ns = 0;
  std::array<std::uint8_t, kSlotsPerPacket> kinds{};
};

/// The classes of simulated packets, found again by device time. A sweep that was assembled from the packets,
/// from a replay of them, or from a live run of their recording (whose hour may differ) gets a class for each
/// of its returns.
///
/// File, little-endian: the 8 bytes "PaGO-LB1"; uint32 firing period in ns, uint32 number of firings in a
/// packet, uint32 number of kinds, uint16 class of each kind; then for each packet int64 time_ns and 384
/// bytes.
class LabelTrack {
 public:
  /// [set-up] Remembers as many packets; later ones replace the oldest.
  LabelTrack(std::size_t capacity, std::int64_t firing_period_ns, int firings_per_packet);
  /// [set-up] All of a file. Throws Error for one that is damaged or of another kind.
  explicit LabelTrack(const std::filesystem::path& file);

  /// [one thread] Packets in order of time. A sweep's packets must have been added before it is labelled.
  void add(const SimulatedPacket& packet) noexcept;

  /// [any one thread] Writes `label` of every return and sets kLabelled; returns whose packet is not known
  /// get class 0. Returns how many were known. `unit` is the calibration that the sweep was decoded with. No
  /// allocation, no lock.
  std::uint32_t label(Sweep& sweep, const hdl64::Calibration& unit) const noexcept;

  std::size_t size() const noexcept { return size_; }

 private:
  const PacketLabels* find(std::int64_t time_ns) const noexcept;
  const PacketLabels& at(std::size_t age) const noexcept;
  std::int64_t hours_off_ns(std::int64_t start_ns) const noexcept;

  std::vector<PacketLabels> packets_;  // a ring
  std::size_t oldest_ = 0, size_ = 0;
  std::int64_t firing_period_ns_;
  int firings_;
};

/// Writes the file that LabelTrack reads, packet by packet. [one thread] Errors are kept as complaint.
class LabelWriter {
 public:
  LabelWriter(std::filesystem::path file, std::int64_t firing_period_ns, int firings_per_packet);
  void write(const SimulatedPacket& packet) noexcept;
  void flush() noexcept { file_.flush(); }
  const std::string& complaint() const noexcept { return file_.complaint(); }

 private:
  output::TextFile file_;
};

}  // namespace pago::simulator

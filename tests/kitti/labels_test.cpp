// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <fstream>
#include <vector>

#include "folders.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"

using namespace pago;
using namespace pago::test;
using Catch::Contains;

namespace {

constexpr std::uint32_t kScanCapacity = 200'000;

/// As SemanticKITTI writes them: the class in the low half, an object's number in the high one.
std::vector<std::uint32_t> labels_for(const KittiScan& scan) {
  std::vector<std::uint32_t> labels(scan.size());
  for (std::uint32_t i = 0; i < labels.size(); ++i) labels[i] = (i % 7U) << 16U | (40U + i % 3U);
  return labels;
}

void write_labels(const std::filesystem::path& file, const std::vector<std::uint32_t>& labels) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(labels.data()),
            static_cast<std::streamsize>(labels.size() * sizeof(std::uint32_t)));
}

bool has_classes(const Sweep& sweep, const std::vector<std::uint32_t>& labels) {
  if (sweep.size != labels.size() || !sweep.header.has(kLabelled)) return false;
  for (std::uint32_t i = 0; i < sweep.size; ++i)
    if (sweep.label[i] != (labels[i] & 0xFFFFU)) return false;
  return true;
}

/// Reads the first scan of `opened`.
bool reads_classes(const std::filesystem::path& opened, const std::vector<std::uint32_t>& labels) {
  Sweep sweep(kScanCapacity);
  KittiSource source(opened);
  return source.fill(sweep) && has_classes(sweep, labels) && source.first_without_labels().empty();
}

}  // namespace

TEST_CASE("labels of the odometry layout come with the scan, whichever folder is opened", "[kitti][labels]") {
  const TemporaryPath root("_kitti");
  const KittiScan scan = round_scan(100);
  const auto labels = labels_for(scan);
  write_scan(root.path() / "velodyne/000000.bin", scan);
  write_labels(root.path() / "labels/000000.label", labels);
  CHECK(reads_classes(root.path(), labels));
  CHECK(reads_classes(root.path() / "velodyne", labels));
}

TEST_CASE("labels of raw recordings are found beside velodyne_points and in it", "[kitti][labels]") {
  const KittiScan scan = round_scan(100);
  const auto labels = labels_for(scan);
  for (const char* folder : {"labels", "velodyne_points/labels"}) {
    CAPTURE(folder);
    const TemporaryPath root("_kitti");
    write_scan(root.path() / "velodyne_points/data/0000000000.bin", scan);
    write_labels(root.path() / folder / "0000000000.label", labels);
    CHECK(reads_classes(root.path(), labels));
  }
}

TEST_CASE("labels can be left unread", "[kitti][labels]") {
  const TemporaryPath root("_kitti");
  const KittiScan scan = round_scan(100);
  write_scan(root.path() / "velodyne/000000.bin", scan);
  write_labels(root.path() / "labels/000000.label", labels_for(scan));
  Sweep sweep(kScanCapacity);
  KittiSource source(root.path(), {.labels = false});
  REQUIRE(source.fill(sweep));
  CHECK_FALSE(sweep.header.has(kLabelled));
  CHECK_THAT(source.first_without_labels(), Contains("000000.bin"));
}

TEST_CASE("a scan without labels among labelled ones is read, and named", "[kitti][labels]") {
  const TemporaryPath root("_kitti");
  const KittiScan scan = round_scan(100);
  const auto labels = labels_for(scan);
  for (const char* name : {"000000", "000001", "000002"})
    write_scan(root.path() / "velodyne" / (std::string(name) + ".bin"), scan);
  for (const char* name : {"000000", "000002"})
    write_labels(root.path() / "labels" / (std::string(name) + ".label"), labels);
  Sweep sweep(kScanCapacity);
  KittiSource source(root.path());
  CHECK_THAT(source.first_without_labels(), Contains("000001.bin"));
  for (const bool is_labelled : {true, false, true}) {
    sweep.reset();
    REQUIRE(source.fill(sweep));
    CHECK(sweep.header.has(kLabelled) == is_labelled);
  }
}

TEST_CASE("labels that are not one for each point end the reading, and say so", "[kitti][labels]") {
  const KittiScan scan = round_scan(100);
  for (const int difference : {-1, 1}) {
    CAPTURE(difference);
    const TemporaryPath root("_kitti");
    write_scan(root.path() / "velodyne/000000.bin", scan);
    auto labels = labels_for(scan);
    labels.resize(static_cast<std::size_t>(static_cast<int>(labels.size()) + difference));
    write_labels(root.path() / "labels/000000.label", labels);
    Sweep sweep(kScanCapacity);
    KittiSource source(root.path());
    CHECK_FALSE(source.fill(sweep));
    CHECK_THAT(source.complaint(), Contains("000000.label") && Contains("4 for each point"));
    CHECK_FALSE(source.fill(sweep));
  }
}

TEST_CASE("labels that cannot be opened end the reading, and say so", "[kitti][labels]") {
  const TemporaryPath root("_kitti");
  write_scan(root.path() / "velodyne/000000.bin", round_scan(100));
  std::filesystem::create_directories(root.path() / "labels/000000.label");  // a folder of that name
  Sweep sweep(kScanCapacity);
  KittiSource source(root.path());
  CHECK_FALSE(source.fill(sweep));
  CHECK_THAT(source.complaint(), Contains("000000.label: cannot be read"));
}

TEST_CASE("a scan of SemanticKITTI is labelled: half of its points are ground", "[kitti][labels]") {
  PAGO_DATA_OR_SKIP(folder, "kitti/semantickitti_single");
  Sweep sweep(kScanCapacity);
  KittiSource source(folder);
  REQUIRE(source.fill(sweep));
  REQUIRE(sweep.header.has(kLabelled));
  std::uint32_t road = 0;
  for (std::uint32_t i = 0; i < sweep.size; ++i) road += sweep.label[i] == 40 ? 1U : 0U;
  CHECK(road > sweep.size / 10);
}

// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/kitti/folder.hpp"

#include "drivers/kitti/stamps.hpp"
#include "folders.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::test;
using Catch::Contains;

namespace {

const KittiScan kOnePoint{{1.0F, 2.0F, 3.0F, 0.5F}};

kitti::Folder open(const std::filesystem::path& folder, int first = 0, int count = 0) {
  KittiConfig config;
  config.first = first;
  config.count = count;
  return kitti::open_folder(folder, config);
}

std::int64_t mid_ns(const kitti::Scan& scan) {
  return scan.start_ns + (scan.end_ns - scan.start_ns) / 2;
}

}  // namespace

TEST_CASE("both layouts are found from the sequence's folder and from the scans' own", "[kitti][folder]") {
  const TemporaryPath root("_kitti");
  write_scan(root.path() / "00/velodyne/000000.bin", kOnePoint);
  write_text(root.path() / "00/times.txt", "5.0\n");
  for (const char* folder : {"00", "00/", "00/velodyne", "00/velodyne/", "00/./velodyne/../velodyne"}) {
    INFO(folder);
    const kitti::Folder found = open(root.path() / folder);
    CHECK_FALSE(found.is_raw);
    CHECK(found.has_stamps);
    REQUIRE(found.scans.size() == 1);
    CHECK(mid_ns(found.scans[0]) == kKittiEpochNs + 5'000'000'000);
  }
  write_scan(root.path() / "drive/velodyne_points/data/0000000000.bin", kOnePoint);
  write_text(root.path() / "drive/velodyne_points/timestamps.txt", "2011-09-26 00:00:05.000000001\n");
  for (const char* folder : {"drive", "drive/velodyne_points", "drive/velodyne_points/data"}) {
    INFO(folder);
    const kitti::Folder found = open(root.path() / folder);
    CHECK(found.is_raw);
    REQUIRE(found.scans.size() == 1);
    CHECK(mid_ns(found.scans[0]) == kKittiEpochNs + 5'000'000'001);
  }
}

TEST_CASE("scans come in the order of their numbers, other files are left out", "[kitti][folder]") {
  const TemporaryPath root("_kitti");
  for (const char* name : {"10.bin", "9.bin", "000008.bin", "._000009.bin", "notes.bin", "11.txt", "-1.bin"})
    write_scan(root.path() / "velodyne" / name, kOnePoint);
  const kitti::Folder found = open(root.path());
  REQUIRE(found.scans.size() == 3);
  CHECK_THAT(found.scans[0].path, Catch::EndsWith("000008.bin"));
  CHECK_THAT(found.scans[2].path, Catch::EndsWith("10.bin"));
  CHECK(found.scans[2].is_last_of_folder);
  CHECK_FALSE(found.has_stamps);
  CHECK(mid_ns(found.scans[1]) - mid_ns(found.scans[0]) == kitti::kNominalPeriodNs);
}

TEST_CASE("rotations meet halfway between stamps", "[kitti][folder]") {
  const TemporaryPath root("_kitti");
  std::string times;
  for (int i = 0; i < 10; ++i) {
    write_scan(root.path() / "velodyne" / (std::to_string(i) + ".bin"), kOnePoint);
    times += std::to_string(i * 0.11) + "\r\n";
  }
  write_text(root.path() / "times.txt", times + "\n");
  const kitti::Folder found = open(root.path());
  for (std::size_t i = 0; i < 10; ++i) {
    CHECK(found.scans[i].end_ns - found.scans[i].start_ns == 110'000'000);
    CHECK(mid_ns(found.scans[i]) == kKittiEpochNs + static_cast<std::int64_t>(i) * 110'000'000);
    CHECK(found.scans[i].sequence == i);
    if (i > 0) CHECK(found.scans[i].start_ns == found.scans[i - 1].end_ns);
  }
}

TEST_CASE("stamps that tell of no rotation leave the period nominal", "[kitti][folder]") {
  CHECK(kitti::period_ns({0}, 0) == kitti::kNominalPeriodNs);
  CHECK(kitti::period_ns({0, 100'000'000, 60'000'000'000}, 2) == kitti::kNominalPeriodNs);
  CHECK(kitti::period_ns({0, 0, 0}, 1) == kitti::kNominalPeriodNs);
  CHECK(kitti::period_ns({0, 50'000'000, 100'000'000}, 1) == 50'000'000);
}

TEST_CASE("missing files leave a gap in numbers and stamps", "[kitti][folder]") {
  const TemporaryPath root("_kitti");
  for (const char* name : {"3.bin", "4.bin", "7.bin"}) write_scan(root.path() / "velodyne" / name, kOnePoint);
  write_text(root.path() / "times.txt", "0\n0.1\n0.2\n0.3\n0.4\n0.5\n0.6\n0.7\n");
  const kitti::Folder found = open(root.path());
  REQUIRE(found.scans.size() == 3);
  CHECK(found.scans[0].sequence == 0);
  CHECK(found.scans[2].sequence == 4);
  CHECK(found.scans[2].is_after_gap);
  CHECK_FALSE(found.scans[1].is_after_gap);
  CHECK(mid_ns(found.scans[2]) == kKittiEpochNs + 700'000'000);
  CHECK(KittiSource(root.path()).missing_scans() == 2);
}

TEST_CASE("an excerpt with stamps of its own is matched one by one", "[kitti][folder]") {
  const TemporaryPath root("_kitti");
  write_scan(root.path() / "velodyne/000100.bin", kOnePoint);
  write_scan(root.path() / "velodyne/000101.bin", kOnePoint);
  write_text(root.path() / "times.txt", "10.0\n10.1\n");
  CHECK(mid_ns(open(root.path()).scans[1]) == kKittiEpochNs + 10'100'000'000);
  write_text(root.path() / "times.txt", "10.0\n10.1\n10.2\n");
  CHECK_THAT(kitti_refusal(root.path()),
             Contains("times.txt") && Contains("3 stamps") && Contains("2 scans"));
}

TEST_CASE("first and count choose an excerpt, counted from zero", "[kitti][folder]") {
  const TemporaryPath root("_kitti");
  for (int i = 0; i < 5; ++i) write_scan(root.path() / "velodyne" / (std::to_string(i) + ".bin"), kOnePoint);
  const kitti::Folder middle = open(root.path(), 2, 2);
  REQUIRE(middle.scans.size() == 2);
  CHECK(middle.scans[0].sequence == 0);
  CHECK_THAT(middle.scans[0].path, Catch::EndsWith("2.bin"));
  CHECK_FALSE(middle.scans[1].is_last_of_folder);
  CHECK(open(root.path(), 4, 100).scans.size() == 1);
  CHECK_THROWS_WITH(open(root.path(), 5), Contains("kitti.first") && Contains("5"));
}

TEST_CASE("folders that hold no sequence are refused with a reason and a hint", "[kitti][folder]") {
  const TemporaryPath root("_kitti");
  CHECK_THAT(kitti_refusal(root.path()), Contains(root.path().string() + ": does not exist"));
  std::filesystem::create_directories(root.path() / "velodyne");
  CHECK_THAT(kitti_refusal(root.path()),
             Contains("holds no KITTI scans") && Contains("velodyne_points/data/"));
  write_scan(root.path() / "velodyne/000000.bin", kOnePoint);
  CHECK_THAT(kitti_refusal(root.path() / "velodyne/000000.bin"), Contains("is not a folder"));
  write_text(root.path() / "times.txt", "0.0\nsoon\n");
  CHECK_THAT(kitti_refusal(root.path()), Contains("times.txt:2") && Contains("'soon'"));
  write_text(root.path() / "times.txt", "nan\n");
  CHECK_THAT(kitti_refusal(root.path()), Contains("times.txt:1"));
  std::filesystem::remove(root.path() / "times.txt");
  write_scan(root.path() / "velodyne/0.bin", kOnePoint);
  CHECK_THAT(kitti_refusal(root.path()), Contains("same number"));
}

TEST_CASE("stamps that stand still or go back are refused by line", "[kitti][folder]") {
  const TemporaryPath file(".txt");
  for (const char* second : {"0.1", "0.0"}) {
    write_text(file.path(), "0.1\n" + std::string(second) + "\n");
    CHECK_THROWS_WITH(kitti::read_seconds(file.path()),
                      Contains(":2: '" + std::string(second) + "' is not later"));
  }
}

TEST_CASE("dates of raw recordings are read to the nanosecond", "[kitti][folder]") {
  const TemporaryPath file(".txt");
  write_text(file.path(), "2000-01-01 00:00:00\n2011-09-26 13:02:25.951199337\n");
  CHECK(kitti::read_dates(file.path()) ==
        std::vector<std::int64_t>{946'684'800'000'000'000, 1'317'042'145'951'199'337});
  for (const char* bad :
       {"2011-13-26 13:02:25.9", "2011-09-26", "2011-09-26 25:02:25", "0.5", "2011-09-26 13:02:25 x"}) {
    write_text(file.path(), bad);
    CHECK_THROWS_WITH(kitti::read_dates(file.path()), Contains(":1: '" + std::string(bad) + "'"));
  }
}

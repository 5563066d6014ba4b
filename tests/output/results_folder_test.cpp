// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/results_folder.hpp"

#include <set>
#include <thread>
#include <vector>

#include "output/scratch_folder.hpp"
#include "pago/core/error.hpp"
#include "pago/output/text_file.hpp"
#include "support/catch.hpp"

namespace {

namespace fs = std::filesystem;
using namespace pago::output;
using Catch::Matchers::Contains;
using pago::test::contents;
using pago::test::ScratchFolder;

const std::chrono::system_clock::time_point kNow{std::chrono::seconds(1'700'000'000)};

TEST_CASE("a run gets a folder named by the time, and latest leads to it", "[output][results_folder]") {
  const ScratchFolder scratch;
  const ResultsFolder results = create_results_folder(scratch.path / "results", kNow);
  CHECK(fs::is_directory(results.folder));
  CHECK(results.folder.parent_path() == scratch.path / "results");
  CHECK_THAT(results.folder.filename().string(),
             Catch::Matchers::Matches("2023-11-1[45]_[0-9]{2}-[0-9]{2}-20"));
  CHECK(fs::equivalent(results.latest, results.folder));
  CHECK(fs::read_symlink(results.latest).is_relative());
  CHECK(results.complaint.empty());
}

TEST_CASE("a file is replaced by a whole one, or not at all", "[output][text_file]") {
  const ScratchFolder scratch;
  const fs::path file = scratch.path / "run.json";
  replace_file(file, [](const fs::path& unfinished) { write_file(unfinished, "first"); });
  CHECK(contents(file) == "first");
  const auto fail = [](const fs::path& unfinished) {
    write_file(unfinished, "half");
    throw pago::Error("disk", "full");
  };
  CHECK_THROWS_WITH(replace_file(file, fail), Contains("full"));
  CHECK(contents(file) == "first");
  CHECK(std::distance(fs::directory_iterator(scratch.path), fs::directory_iterator{}) == 1);
}

TEST_CASE("runs in the same second do not share a folder, and latest is the last one",
          "[output][results_folder]") {
  const ScratchFolder scratch;
  const ResultsFolder first = create_results_folder(scratch.path, kNow);
  write_file(first.folder / "run.json", "first");
  const ResultsFolder second = create_results_folder(scratch.path, kNow);
  CHECK(second.folder.string() == first.folder.string() + "_2");
  CHECK(create_results_folder(scratch.path, kNow).folder.string() == first.folder.string() + "_3");
  CHECK(contents(first.folder / "run.json") == "first");
  CHECK(fs::read_symlink(scratch.path / "latest") == first.folder.filename().string() + "_3");
  // Nothing but the runs and the link is left behind.
  CHECK(std::distance(fs::directory_iterator(scratch.path), fs::directory_iterator{}) == 4);
}

TEST_CASE("runs that start at the same time get different folders", "[output][results_folder]") {
  const ScratchFolder scratch;
  std::vector<fs::path> folders(8);
  std::vector<std::thread> threads;
  for (fs::path& folder : folders)
    threads.emplace_back([&folder, &scratch] { folder = create_results_folder(scratch.path, kNow).folder; });
  for (std::thread& thread : threads) thread.join();
  CHECK(std::set<fs::path>(folders.begin(), folders.end()).size() == folders.size());
}

TEST_CASE("something else named latest is left alone and mentioned", "[output][results_folder]") {
  const ScratchFolder scratch;
  write_file(scratch.path / "latest", "mine");
  const ResultsFolder results = create_results_folder(scratch.path, kNow);
  CHECK(fs::is_directory(results.folder));
  CHECK_THAT(results.complaint, Contains("latest: is not a link"));
  CHECK(contents(scratch.path / "latest") == "mine");
}

TEST_CASE("a latest that leads nowhere is replaced", "[output][results_folder]") {
  const ScratchFolder scratch;
  fs::create_symlink("gone", scratch.path / "latest");
  CHECK(create_results_folder(scratch.path, kNow).complaint.empty());
  CHECK(fs::is_directory(scratch.path / "latest"));
}

TEST_CASE("a place where no folder can be made is refused by name", "[output][results_folder]") {
  CHECK_THROWS_WITH(create_results_folder("/dev/null/results", kNow),
                    Contains("/dev/null/results: the folder cannot"));
}

}  // namespace

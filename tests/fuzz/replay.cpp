// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Stands in for libFuzzer where there is none: every file of a corpus, then inputs derived from them, the
// same ones each time.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include "fuzz/fuzz.hpp"

using Bytes = std::vector<std::uint8_t>;

namespace {

constexpr std::size_t kMostBytes = 16'384;

std::vector<Bytes> read_corpus(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files(std::filesystem::directory_iterator(folder), {});
  std::sort(files.begin(), files.end());
  std::vector<Bytes> corpus;
  for (const auto& file : files) {
    std::ifstream in(file, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return corpus;
}

/// One of the corpus with a few bytes changed, left out, repeated, or continued by another one's.
class Deriver {
 public:
  explicit Deriver(const std::vector<Bytes>& corpus) : corpus_(corpus) {}

  Bytes next() {
    Bytes bytes = corpus_[below(corpus_.size())];
    for (std::size_t changes = 1 + below(6); changes > 0; --changes) change(bytes);
    bytes.resize(std::min(bytes.size(), kMostBytes));
    return bytes;
  }

 private:
  std::size_t below(std::size_t limit) { return random_() % std::max<std::size_t>(1, limit); }
  void change(Bytes& bytes) {
    const auto at = bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size()));
    const auto until = at + static_cast<std::ptrdiff_t>(below(static_cast<std::size_t>(bytes.end() - at)));
    const Bytes part(at, until);
    const Bytes& other = corpus_[below(corpus_.size())];
    switch (below(5)) {
      case 0:
        bytes.erase(at, until);
        break;
      case 1:
        bytes.insert(at, part.begin(), part.end());
        break;
      case 2:
        bytes.resize(static_cast<std::size_t>(at - bytes.begin()));
        bytes.insert(bytes.end(), other.begin() + static_cast<std::ptrdiff_t>(below(other.size())),
                     other.end());
        break;
      case 3:
        if (!bytes.empty()) *at = static_cast<std::uint8_t>(random_());
        break;
      default:
        if (!bytes.empty()) *at = static_cast<std::uint8_t>(*at ^ 1U << below(8));
        break;
    }
  }
  const std::vector<Bytes>& corpus_;
  std::mt19937 random_{1};
};

}  // namespace

int main(int argc, char** argv) {
  const std::vector<Bytes> corpus = argc == 3 ? read_corpus(argv[1]) : std::vector<Bytes>{};
  if (corpus.empty()) {
    std::fputs("usage: NAME CORPUS-FOLDER NUMBER-OF-DERIVED-INPUTS\n", stderr);
    return 2;
  }
  for (const Bytes& bytes : corpus) LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  Deriver derive(corpus);
  for (int i = std::atoi(argv[2]); i > 0; --i) {
    const Bytes bytes = derive.next();
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  return 0;
}

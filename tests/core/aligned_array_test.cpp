// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/core/aligned_array.hpp"

#include <cstdint>
#include <vector>

#include "support/catch.hpp"

using pago::AlignedArray;
using pago::FixedVector;

namespace {

bool is_aligned(const void* p) {
  return reinterpret_cast<std::uintptr_t>(p) % pago::kCacheLineBytes == 0;
}

}  // namespace

TEST_CASE("an array begins on a cache line and holds the value it was made with", "[core][aligned_array]") {
  for (const std::size_t size : {0U, 1U, 3U, 63U, 64U, 1000U}) {
    const AlignedArray<std::uint8_t> bytes(size, 7);
    const AlignedArray<double> zeros(size);
    CHECK(is_aligned(bytes.data()));
    CHECK(is_aligned(zeros.data()));
    CHECK(bytes.size() == size);
    CHECK(std::count(bytes.begin(), bytes.end(), 7) == static_cast<std::ptrdiff_t>(size));
    CHECK(std::count(zeros.begin(), zeros.end(), 0.0) == static_cast<std::ptrdiff_t>(size));
  }
}

TEST_CASE("an array that was not given a size is empty", "[core][aligned_array]") {
  const AlignedArray<int> none;
  CHECK(none.size() == 0);
  CHECK(none.begin() == none.end());
  CHECK(none.first(0).empty());
}

TEST_CASE("views and elements are the same memory", "[core][aligned_array]") {
  AlignedArray<int> array(10);
  for (std::size_t i = 0; i < array.size(); ++i) array[i] = static_cast<int>(i);
  CHECK(array.first(4).size() == 4);
  CHECK(&array.first(4)[3] == array.data() + 3);
  array.first(10)[9] = 99;
  CHECK(array[9] == 99);
}

TEST_CASE("moving an array moves its memory, not its contents", "[core][aligned_array]") {
  AlignedArray<int> source(5, 3);
  const int* const memory = source.data();
  const AlignedArray<int> target = std::move(source);
  CHECK(target.data() == memory);
  CHECK(target.size() == 5);
}

TEST_CASE("a full list refuses, keeps what it has and says so", "[core][fixed_vector]") {
  FixedVector<int> list(3);
  CHECK(list.capacity() == 3);
  CHECK(list.empty());
  CHECK(list.push_back(1));
  CHECK(list.push_back(2));
  CHECK(list.push_back(3));
  CHECK_FALSE(list.push_back(4));
  CHECK(std::vector<int>(list.begin(), list.end()) == std::vector<int>{1, 2, 3});
  CHECK(list.view().size() == 3);
}

TEST_CASE("clearing and shortening keep the memory", "[core][fixed_vector]") {
  FixedVector<int> list(3);
  for (int i = 0; i < 3; ++i) list.push_back(i);
  const int* const memory = list.begin();
  list.truncate(1);
  CHECK(list.size() == 1);
  CHECK(list[0] == 0);
  CHECK(list.push_back(9));
  CHECK(list[1] == 9);
  list.clear();
  CHECK(list.empty());
  CHECK(list.begin() == memory);
  CHECK(list.capacity() == 3);
  FixedVector<int> without_capacity;
  CHECK_FALSE(without_capacity.push_back(1));
}

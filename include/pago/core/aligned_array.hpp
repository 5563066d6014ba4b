// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

namespace pago {

inline constexpr std::size_t kCacheLineBytes = 64;

/// An array whose length is fixed when it is made: cache-line aligned, value-initialised, and touched, so
/// that using it later takes no page fault. [set-up] constructor allocates; [any thread] everything else,
/// real-time safe.
template <typename T>
class AlignedArray {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t size, T value = T{}) : size_(size) {
    const std::size_t bytes = std::max<std::size_t>(1, size) * sizeof(T);
    data_.reset(static_cast<T*>(::operator new (bytes, std::align_val_t{kCacheLineBytes})));
    std::uninitialized_fill_n(data_.get(), size, value);
  }

  T& operator[](std::size_t i) noexcept {
    assert(i < size_);
    return data_[i];
  }
  const T& operator[](std::size_t i) const noexcept {
    assert(i < size_);
    return data_[i];
  }
  T* data() noexcept { return data_.get(); }
  const T* data() const noexcept { return data_.get(); }
  std::size_t size() const noexcept { return size_; }
  T* begin() noexcept { return data(); }
  T* end() noexcept { return data() + size_; }
  const T* begin() const noexcept { return data(); }
  const T* end() const noexcept { return data() + size_; }
  std::span<const T> first(std::size_t n) const noexcept {
    assert(n <= size_);
    return {data(), n};
  }
  std::span<T> first(std::size_t n) noexcept {
    assert(n <= size_);
    return {data(), n};
  }

 private:
  struct Free {
    void operator()(T* p) const noexcept { ::operator delete (p, std::align_val_t{kCacheLineBytes}); }
  };
  std::unique_ptr<T[], Free> data_;
  std::size_t size_ = 0;
};

/// A list with a fixed capacity: `push_back` on a full list changes nothing and says so.
template <typename T>
class FixedVector {
 public:
  FixedVector() = default;
  explicit FixedVector(std::size_t capacity) : storage_(capacity) {}

  bool push_back(const T& value) noexcept {
    if (size_ == storage_.size()) return false;
    storage_[size_++] = value;
    return true;
  }
  void clear() noexcept { size_ = 0; }
  /// Shortens the list; `size` must not exceed the present one.
  void truncate(std::size_t size) noexcept {
    assert(size <= size_);
    size_ = size;
  }
  std::size_t size() const noexcept { return size_; }
  std::size_t capacity() const noexcept { return storage_.size(); }
  bool empty() const noexcept { return size_ == 0; }
  T& operator[](std::size_t i) noexcept {
    assert(i < size_);
    return storage_[i];
  }
  const T& operator[](std::size_t i) const noexcept {
    assert(i < size_);
    return storage_[i];
  }
  T* begin() noexcept { return storage_.data(); }
  T* end() noexcept { return storage_.data() + size_; }
  const T* begin() const noexcept { return storage_.data(); }
  const T* end() const noexcept { return storage_.data() + size_; }
  std::span<const T> view() const noexcept { return storage_.first(size_); }

 private:
  AlignedArray<T> storage_;
  std::size_t size_ = 0;
};

}  // namespace pago

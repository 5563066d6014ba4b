// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// The malloc family, each counted and passed on to glibc's own under its second name. A program that defines
// these replaces them everywhere, inside shared libraries too (glibc manual, "Replacing malloc").

#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>

#include "support/alloc_guard_hooks.hpp"

using pago::test::on_allocate;
using pago::test::on_free;

extern "C" {

void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* memory);

void* malloc(std::size_t size) noexcept {
  on_allocate();
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  on_allocate();
  return __libc_calloc(count, size);
}

void* realloc(void* memory, std::size_t size) noexcept {
  on_allocate();
  return __libc_realloc(memory, size);
}

void* reallocarray(void* memory, std::size_t count, std::size_t size) noexcept {
  if (size != 0 && count > SIZE_MAX / size) {
    errno = ENOMEM;
    return nullptr;
  }
  return realloc(memory, count * size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  on_allocate();
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return memalign(alignment, size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  const bool is_power_of_two = alignment != 0 && (alignment & (alignment - 1)) == 0;
  if (!is_power_of_two || alignment % sizeof(void*) != 0) return EINVAL;
  void* const result = memalign(alignment, size);
  if (result == nullptr) return ENOMEM;
  *memory = result;
  return 0;
}

void* valloc(std::size_t size) noexcept {
  return memalign(static_cast<std::size_t>(sysconf(_SC_PAGESIZE)), size);
}

void free(void* memory) noexcept {
  if (memory == nullptr) return;
  on_free();
  __libc_free(memory);
}

}  // extern "C"

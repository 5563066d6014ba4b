// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// The sanitizers bring their own malloc, and hooks into it.

#include <cstddef>
#include <cstdlib>

#include "support/alloc_guard_hooks.hpp"

// As in sanitizer/allocator_interface.h, which GCC does not install. 0: no room for another pair of hooks.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*allocated)(const volatile void*, std::size_t),
                                                         void (*freed)(const volatile void*));

namespace {

void allocated(const volatile void*, std::size_t) {
  pago::test::on_allocate();
}
void freed(const volatile void* memory) {
  if (memory != nullptr) pago::test::on_free();
}

[[gnu::constructor]] void install() {
  if (__sanitizer_install_malloc_and_free_hooks(allocated, freed) == 0) std::abort();
}

}  // namespace

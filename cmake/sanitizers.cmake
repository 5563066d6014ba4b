# PAGO_SANITIZE = address (with undefined behaviour) | thread | empty
set(PAGO_SANITIZE "" CACHE STRING "address, thread or empty")
set_property(CACHE PAGO_SANITIZE PROPERTY STRINGS "" address thread)
if(PAGO_SANITIZE STREQUAL "address")
  # AddressSanitizer finds what these three find, and Eigen's expressions compile and run twice as fast without them.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize=null,object-size,vptr -fno-sanitize-recover=all
    -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
elseif(PAGO_SANITIZE STREQUAL "thread")
  add_compile_options(-fsanitize=thread -fno-omit-frame-pointer)
  add_link_options(-fsanitize=thread)
elseif(PAGO_SANITIZE)
  message(FATAL_ERROR "PAGO_SANITIZE must be address, thread or empty, is '${PAGO_SANITIZE}'")
endif()

# For libFuzzer to see which way a program takes (tests/fuzz); clang only.
option(PAGO_FUZZ "build tests/fuzz with libFuzzer" OFF)
if(PAGO_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

# Fast enough to run real drives under a sanitizer, with assertions and line numbers.
set(CMAKE_CXX_FLAGS_SANITIZE "-O1 -g1")
set(CMAKE_C_FLAGS_SANITIZE "-O1 -g1")

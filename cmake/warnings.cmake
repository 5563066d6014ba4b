# Flags that every target of ours is compiled with.
add_library(pago_warnings INTERFACE)
target_compile_options(pago_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Werror -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-align
  -Wunused -Woverloaded-virtual -Wconversion -Wsign-conversion -Wdouble-promotion -Wformat=2
  -Wimplicit-fallthrough -Wnull-dereference)
# g++ 12 reports false positives deep inside Eigen's and fmt's templates at -O3.
target_compile_options(pago_warnings INTERFACE
  $<$<CXX_COMPILER_ID:GNU>:-Wduplicated-cond -Wlogical-op -Wno-null-dereference
    -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow>)
# Conditions without branches are what vector code is made of.
target_compile_options(pago_warnings INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical>)

# x86-64-v3 raises Eigen's default alignment to 32 bytes, which does not match a distribution's libceres.
add_library(pago_abi INTERFACE)
target_compile_definitions(pago_abi INTERFACE EIGEN_MAX_ALIGN_BYTES=16)

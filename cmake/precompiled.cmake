# The headers that most files include, compiled once instead of with each of them. A file must still include all that it
# uses: the preset `fuzz` builds without this, and finds what was forgotten.
option(PAGO_PRECOMPILE "compile common headers once" ON)

set(PAGO_COMMON_HEADERS
  <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <memory> <optional> <span> <string> <vector>
  <Eigen/Core> <Eigen/Geometry>)

# pago_precompile(TARGET FIRST [HEADER ...]): with the common headers and those named. Targets that name the same FIRST
# target share what was made for it, so they must be compiled with the same options.
function(pago_precompile target first)
  if(NOT PAGO_PRECOMPILE)
    return()
  endif()
  if(target STREQUAL first)
    target_precompile_headers(${target} PRIVATE ${PAGO_COMMON_HEADERS} ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM ${first})
  endif()
endfunction()

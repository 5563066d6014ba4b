# Haswell and newer (2013): AVX2, FMA, BMI. Within 5 % of -march=native on the kernels that matter, and portable.
set(CMAKE_CXX_FLAGS_INIT "-march=x86-64-v3")
set(CMAKE_C_FLAGS_INIT "-march=x86-64-v3")
# CMake appends -O3 -DNDEBUG for Release itself.

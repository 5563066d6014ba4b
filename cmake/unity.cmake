# A build from nothing takes half the time when each folder is compiled as one file; a change to one of its files takes
# longer then. ./bootstrap, which builds what a machine does not have yet, does so.
option(PAGO_UNITY "compile each folder as one file" OFF)
set(CMAKE_UNITY_BUILD ${PAGO_UNITY})
set(CMAKE_UNITY_BUILD_BATCH_SIZE 0)
if(PAGO_UNITY)
  # A type of one .cpp file may use that file's anonymous namespace, which an included file must not.
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>)
endif()

# pago_module(NAME SOURCES a.cpp ... [USES module ...] [LINKS target ...] [NOT_PRECOMPILED])
#
# NOT_PRECOMPILED: for a folder with compiler options of its own.
#
# One object library per folder. A module sees the public headers (include/pago/<module>) of itself, of the modules
# that it USES and of what those use, and no others: its include path is a folder of links to just these. So an
# include against the arrows app -> pipeline -> stages -> config -> core does not compile.
set(PAGO_MODULES "" CACHE INTERNAL "")

function(pago_module name)
  cmake_parse_arguments(arg "NOT_PRECOMPILED" "" "SOURCES;USES;LINKS" ${ARGN})
  set(seen ${name})
  foreach(used IN LISTS arg_USES)
    get_target_property(reach pago_${used} PAGO_REACH)
    list(APPEND seen ${reach})
  endforeach()
  list(REMOVE_DUPLICATES seen)

  set(view ${CMAKE_BINARY_DIR}/includes/${name})
  file(REMOVE_RECURSE ${view})
  file(MAKE_DIRECTORY ${view}/pago)
  foreach(module IN LISTS seen)
    if(EXISTS ${PROJECT_SOURCE_DIR}/include/pago/${module})
      file(CREATE_LINK ${PROJECT_SOURCE_DIR}/include/pago/${module} ${view}/pago/${module} SYMBOLIC)
    endif()
  endforeach()

  add_library(pago_${name} OBJECT ${arg_SOURCES})
  set_target_properties(pago_${name} PROPERTIES PAGO_REACH "${seen}")
  target_include_directories(pago_${name} PRIVATE ${view})
  target_link_libraries(pago_${name} PRIVATE pago_warnings PUBLIC pago_abi Eigen3::Eigen Threads::Threads ${arg_LINKS})
  if(NOT arg_NOT_PRECOMPILED)
    pago_precompile(pago_${name} pago_core)
  endif()
  set(PAGO_MODULES ${PAGO_MODULES} ${name} CACHE INTERNAL "")
endfunction()

# The one library that programs link: every module's objects, every public header.
function(pago_library)
  add_library(pago STATIC)
  add_library(pago::pago ALIAS pago)
  foreach(module IN LISTS PAGO_MODULES)
    target_sources(pago PRIVATE $<TARGET_OBJECTS:pago_${module}>)
    get_target_property(links pago_${module} INTERFACE_LINK_LIBRARIES)
    list(FILTER links EXCLUDE REGEX "pago_")
    target_link_libraries(pago PUBLIC ${links})
  endforeach()
  get_target_property(definitions pago_abi INTERFACE_COMPILE_DEFINITIONS)
  target_compile_definitions(pago PUBLIC ${definitions})
  target_compile_features(pago PUBLIC cxx_std_20)
  target_include_directories(pago PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
endfunction()

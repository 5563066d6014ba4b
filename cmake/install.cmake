# `cmake --install build/release --prefix X` lays out the program, the library and its headers, so that
#   find_package(pago)  target_link_libraries(mine pago::pago)
# works with X on CMAKE_PREFIX_PATH (docs/library-example).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# A static library's users link what it links. Which package brings each of these targets:
set(packages
  Eigen3::Eigen "Eigen3 3.4"
  Threads::Threads "Threads"
  Ceres::ceres "Ceres"
  embree "embree 3"
  PNG::PNG "PNG"
  spdlog::spdlog "spdlog"
  pugixml::pugixml "pugixml"
  yaml-cpp "yaml-cpp"
  yaml-cpp::yaml-cpp "yaml-cpp")

get_target_property(links pago LINK_LIBRARIES)
list(FILTER links EXCLUDE REGEX "^\\$<BUILD_INTERFACE:|^/|^-l|^(pcap|rt|dl)$")
list(REMOVE_DUPLICATES links)
set(dependencies "")
foreach(link IN LISTS links)
  list(FIND packages ${link} at)
  if(at EQUAL -1)
    message(FATAL_ERROR "cmake/install.cmake does not know which package brings ${link}")
  endif()
  math(EXPR at "${at} + 1")
  list(GET packages ${at} package)
  string(APPEND dependencies "find_dependency(${package})\n")
endforeach()

set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/pago)
file(WRITE ${PROJECT_BINARY_DIR}/pagoConfig.cmake
  "include(CMakeFindDependencyMacro)\n${dependencies}include(\${CMAKE_CURRENT_LIST_DIR}/pagoTargets.cmake)\n")
write_basic_package_version_file(${PROJECT_BINARY_DIR}/pagoConfigVersion.cmake COMPATIBILITY SameMinorVersion)

install(TARGETS pago EXPORT pagoTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT pagoTargets NAMESPACE pago:: DESTINATION ${config_folder})
install(FILES ${PROJECT_BINARY_DIR}/pagoConfig.cmake ${PROJECT_BINARY_DIR}/pagoConfigVersion.cmake
  DESTINATION ${config_folder})
install(DIRECTORY include/pago DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING REGEX "\\.hpp$|\\.h$")
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(TARGET pago_program)
  install(TARGETS pago_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

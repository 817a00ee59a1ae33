# What an engine needs from a built Lantern: the library, public headers, shaders, settings, Plugin.json, and a CMake package.
#   cmake --install Build --prefix FOLDER; then find_package(Lantern) with FOLDER in CMAKE_PREFIX_PATH
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(LANTERN_INSTALL_DATA ${CMAKE_INSTALL_DATADIR}/lantern)
set(LANTERN_INSTALL_CMAKE ${CMAKE_INSTALL_LIBDIR}/cmake/Lantern)

install(TARGETS LanternModule LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS LanternModuleHeaders EXPORT LanternTargets)
install(EXPORT LanternTargets NAMESPACE Lantern:: DESTINATION ${LANTERN_INSTALL_CMAKE})
get_property(LANTERN_ENGINE_MODULES GLOBAL PROPERTY LANTERN_ENGINE_MODULES)
foreach(MODULE IN LISTS LANTERN_ENGINE_MODULES)
  install(DIRECTORY Source/${MODULE}/Public/ DESTINATION include/Lantern)
endforeach()
install(DIRECTORY Config Shaders DESTINATION ${LANTERN_INSTALL_DATA}) # beside Plugin.json, which names them
install(FILES Plugin.json LICENSE DESTINATION ${LANTERN_INSTALL_DATA})

configure_package_config_file(Scripts/CMake/LanternConfig.cmake.in ${CMAKE_BINARY_DIR}/LanternConfig.cmake
  INSTALL_DESTINATION ${LANTERN_INSTALL_CMAKE} PATH_VARS LANTERN_INSTALL_DATA CMAKE_INSTALL_LIBDIR)
# Minor versions of 0 may break what was compiled against them.
write_basic_package_version_file(${CMAKE_BINARY_DIR}/LanternConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/LanternConfig.cmake ${CMAKE_BINARY_DIR}/LanternConfigVersion.cmake
  DESTINATION ${LANTERN_INSTALL_CMAKE})

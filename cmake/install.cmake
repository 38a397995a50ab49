# The program, the library, its headers and data, and the package that find_package(edgewise) finds.
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/edgewise)

set(parts options analytic sdf scenes pipeline)
if(EDGEWISE_ORACLE)
  list(APPEND parts exact)
endif()
foreach(part ${parts})
  set_target_properties(edgewise_${part} PROPERTIES EXPORT_NAME ${part})
  install(TARGETS edgewise_${part} EXPORT edgewise_targets)
endforeach()
install(TARGETS edgewise)
install(EXPORT edgewise_targets NAMESPACE edgewise:: FILE edgewiseTargets.cmake DESTINATION ${package_folder})

foreach(room analytic sdf pipeline shaders)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/edgewise
    FILES_MATCHING PATTERN "*.h" PATTERN "*.glsl" PATTERN cli EXCLUDE)
endforeach()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/data DESTINATION ${CMAKE_INSTALL_DATADIR}/edgewise
  PATTERN generate EXCLUDE)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/edgewiseConfig.cmake.in
  ${PROJECT_BINARY_DIR}/edgewiseConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/edgewiseConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/edgewiseConfig.cmake ${PROJECT_BINARY_DIR}/edgewiseConfigVersion.cmake
  ${CMAKE_CURRENT_LIST_DIR}/find_webp.cmake DESTINATION ${package_folder})

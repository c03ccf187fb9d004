# Installs the package files that find_package(tsuya COMPONENTS ...) reads.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/tsuya")
get_property(components GLOBAL PROPERTY TSUYA_COMPONENTS)
set(component_needs "")
foreach(component IN LISTS components)
    install(EXPORT tsuya_${component}_targets NAMESPACE tsuya:: DESTINATION ${package_dir}
            FILE tsuya_${component}_targets.cmake COMPONENT ${component})
    # What a component stands on is what its library links, so the two cannot differ.
    get_target_property(linked tsuya_${component} INTERFACE_LINK_LIBRARIES)
    list(FILTER linked INCLUDE REGEX "^tsuya::")
    list(TRANSFORM linked REPLACE "^tsuya::" "")
    list(JOIN linked " " needs)
    string(APPEND component_needs "set(tsuya_needs_${component} ${needs})\n")
endforeach()

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/tsuyaConfig.cmake.in"
    "${PROJECT_BINARY_DIR}/tsuyaConfig.cmake" INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file("${PROJECT_BINARY_DIR}/tsuyaConfigVersion.cmake"
    COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/tsuyaConfig.cmake"
              "${PROJECT_BINARY_DIR}/tsuyaConfigVersion.cmake"
              "${CMAKE_CURRENT_LIST_DIR}/FindOpenSubdiv.cmake"
              "${CMAKE_CURRENT_LIST_DIR}/FindOpenImageIO.cmake"
              "${CMAKE_CURRENT_LIST_DIR}/FindOpenColorIO.cmake"
        DESTINATION ${package_dir} COMPONENT package)

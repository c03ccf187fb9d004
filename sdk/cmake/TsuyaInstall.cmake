# Installs the package files that find_package(tsuya COMPONENTS ...) and pkg-config read.
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
              "${CMAKE_CURRENT_LIST_DIR}/FindOpenColorIO.cmake"
              "${CMAKE_CURRENT_LIST_DIR}/FindLittleCms.cmake"
        DESTINATION ${package_dir} COMPONENT package)

# For pkg-config: what libraries of others are called on the linker's command line.
set(pc_of_TBB::tbb -ltbb)
set(pc_of_embree -lembree3)
set(pc_of_LittleCms::LittleCms -llcms2)
set(pc_of_OpenColorIO::OpenColorIO -lOpenColorIO)
set(pc_of_pugixml::pugixml -lpugixml)
set(pc_of_draco::draco -ldraco)
set(pc_of_meshoptimizer::meshoptimizer -lmeshoptimizer)
set(pc_of_OpenMeshCore -lOpenMeshCore)
set(pc_of_OpenSubdiv::osdCPU -losdCPU)
set(pc_of_PkgConfig::gpiodcxx -lgpiodcxx)
set(pc_of_tomlplusplus::tomlplusplus -ltomlplusplus)
set(pc_only_headers glm::glm)

file(RELATIVE_PATH pc_prefix "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
string(REGEX REPLACE "/$" "" pc_prefix "${pc_prefix}")
foreach(component IN LISTS components)
    set(pc_requires "")
    set(pc_libs "")
    get_target_property(type tsuya_${component} TYPE)
    if(NOT type STREQUAL INTERFACE_LIBRARY)
        set(pc_libs "-L\${libdir}" -ltsuya_${component})
    endif()
    if(component MATCHES "^(color|garment)$") # load their modules
        list(APPEND pc_libs -Wl,-rpath,\${libdir}/tsuya)
    endif()
    get_target_property(linked tsuya_${component} INTERFACE_LINK_LIBRARIES)
    list(TRANSFORM linked REPLACE "^.<LINK_ONLY:(.*)>$" "\\1")
    foreach(needed IN LISTS linked)
        if(needed MATCHES "^tsuya::(.*)$")
            list(APPEND pc_requires tsuya-${CMAKE_MATCH_1})
        elseif(pc_of_${needed})
            list(APPEND pc_libs ${pc_of_${needed}})
        elseif(NOT needed IN_LIST pc_only_headers AND NOT needed MATCHES "^.<BUILD_INTERFACE:")
            message(FATAL_ERROR "TsuyaInstall.cmake does not know the linker's name of ${needed}")
        endif()
    endforeach()
    list(JOIN pc_requires " " pc_requires)
    list(JOIN pc_libs " " pc_libs)
    configure_file("${CMAKE_CURRENT_LIST_DIR}/tsuya.pc.in"
        "${PROJECT_BINARY_DIR}/pkgconfig/tsuya-${component}.pc" @ONLY)
    install(FILES "${PROJECT_BINARY_DIR}/pkgconfig/tsuya-${component}.pc"
            DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT ${component})
endforeach()

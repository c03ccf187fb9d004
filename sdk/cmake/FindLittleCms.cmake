# LittleCms::LittleCms. The package has a pkg-config file and no config of CMake's.
include(FindPackageHandleStandardArgs)
find_path(LittleCms_INCLUDE_DIR lcms2.h)
find_library(LittleCms_LIBRARY lcms2)
find_package_handle_standard_args(LittleCms
    REQUIRED_VARS LittleCms_LIBRARY LittleCms_INCLUDE_DIR)
mark_as_advanced(LittleCms_INCLUDE_DIR LittleCms_LIBRARY)
if(LittleCms_FOUND AND NOT TARGET LittleCms::LittleCms)
    add_library(LittleCms::LittleCms UNKNOWN IMPORTED)
    set_target_properties(LittleCms::LittleCms PROPERTIES
        IMPORTED_LOCATION "${LittleCms_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${LittleCms_INCLUDE_DIR}")
endif()

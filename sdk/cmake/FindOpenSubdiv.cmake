# OpenSubdiv::osdCPU. Debian's own config names a static library that the package does not ship.
include(FindPackageHandleStandardArgs)
find_path(OpenSubdiv_INCLUDE_DIR opensubdiv/bfr/surface.h)
find_library(OpenSubdiv_LIBRARY osdCPU)
find_package_handle_standard_args(OpenSubdiv
    REQUIRED_VARS OpenSubdiv_LIBRARY OpenSubdiv_INCLUDE_DIR)
mark_as_advanced(OpenSubdiv_INCLUDE_DIR OpenSubdiv_LIBRARY)
if(OpenSubdiv_FOUND AND NOT TARGET OpenSubdiv::osdCPU)
    add_library(OpenSubdiv::osdCPU UNKNOWN IMPORTED)
    set_target_properties(OpenSubdiv::osdCPU PROPERTIES
        IMPORTED_LOCATION "${OpenSubdiv_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${OpenSubdiv_INCLUDE_DIR}")
endif()

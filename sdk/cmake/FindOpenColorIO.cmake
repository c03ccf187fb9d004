# OpenColorIO::OpenColorIO. Debian's own config names include folders that the package does not ship.
include(FindPackageHandleStandardArgs)
find_path(OpenColorIO_INCLUDE_DIR OpenColorIO/OpenColorIO.h)
find_library(OpenColorIO_LIBRARY OpenColorIO)
find_package_handle_standard_args(OpenColorIO
    REQUIRED_VARS OpenColorIO_LIBRARY OpenColorIO_INCLUDE_DIR)
mark_as_advanced(OpenColorIO_INCLUDE_DIR OpenColorIO_LIBRARY)
if(OpenColorIO_FOUND AND NOT TARGET OpenColorIO::OpenColorIO)
    add_library(OpenColorIO::OpenColorIO UNKNOWN IMPORTED)
    set_target_properties(OpenColorIO::OpenColorIO PROPERTIES
        IMPORTED_LOCATION "${OpenColorIO_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${OpenColorIO_INCLUDE_DIR}")
endif()

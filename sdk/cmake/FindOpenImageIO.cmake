# OpenImageIO::OpenImageIO. Debian's own config names include folders that the package does not ship.
include(FindPackageHandleStandardArgs)
find_path(OpenImageIO_INCLUDE_DIR OpenImageIO/imageio.h)
find_path(OpenImageIO_IMATH_INCLUDE_DIR ImathVec.h PATH_SUFFIXES Imath)
find_library(OpenImageIO_LIBRARY OpenImageIO)
find_library(OpenImageIO_UTIL_LIBRARY OpenImageIO_Util)
find_library(OpenImageIO_IMATH_LIBRARY NAMES Imath-3_1 Imath)
find_package_handle_standard_args(OpenImageIO REQUIRED_VARS
    OpenImageIO_LIBRARY OpenImageIO_UTIL_LIBRARY OpenImageIO_IMATH_LIBRARY
    OpenImageIO_INCLUDE_DIR OpenImageIO_IMATH_INCLUDE_DIR)
mark_as_advanced(OpenImageIO_INCLUDE_DIR OpenImageIO_IMATH_INCLUDE_DIR OpenImageIO_LIBRARY
    OpenImageIO_UTIL_LIBRARY OpenImageIO_IMATH_LIBRARY)
if(OpenImageIO_FOUND AND NOT TARGET OpenImageIO::OpenImageIO)
    add_library(OpenImageIO::OpenImageIO UNKNOWN IMPORTED)
    set_target_properties(OpenImageIO::OpenImageIO PROPERTIES
        IMPORTED_LOCATION "${OpenImageIO_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES
            "${OpenImageIO_INCLUDE_DIR};${OpenImageIO_IMATH_INCLUDE_DIR}"
        INTERFACE_LINK_LIBRARIES "${OpenImageIO_UTIL_LIBRARY};${OpenImageIO_IMATH_LIBRARY}")
endif()

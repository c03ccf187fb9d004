# OpenEXR::OpenEXR. Debian's own config names Python libraries that its packages do not ship.
include(FindPackageHandleStandardArgs)
find_path(OpenEXR_INCLUDE_DIR ImfOutputFile.h PATH_SUFFIXES OpenEXR)
find_path(OpenEXR_IMATH_INCLUDE_DIR ImathVec.h PATH_SUFFIXES Imath)
find_library(OpenEXR_LIBRARY NAMES OpenEXR-3_1 OpenEXR)
find_library(OpenEXR_IEX_LIBRARY NAMES Iex-3_1 Iex)
find_library(OpenEXR_IMATH_LIBRARY NAMES Imath-3_1 Imath)
find_package_handle_standard_args(OpenEXR REQUIRED_VARS
    OpenEXR_LIBRARY OpenEXR_IEX_LIBRARY OpenEXR_IMATH_LIBRARY
    OpenEXR_INCLUDE_DIR OpenEXR_IMATH_INCLUDE_DIR)
mark_as_advanced(OpenEXR_INCLUDE_DIR OpenEXR_IMATH_INCLUDE_DIR OpenEXR_LIBRARY OpenEXR_IEX_LIBRARY
    OpenEXR_IMATH_LIBRARY)
if(OpenEXR_FOUND AND NOT TARGET OpenEXR::OpenEXR)
    add_library(OpenEXR::OpenEXR UNKNOWN IMPORTED)
    set_target_properties(OpenEXR::OpenEXR PROPERTIES
        IMPORTED_LOCATION "${OpenEXR_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${OpenEXR_INCLUDE_DIR};${OpenEXR_IMATH_INCLUDE_DIR}"
        INTERFACE_LINK_LIBRARIES "${OpenEXR_IEX_LIBRARY};${OpenEXR_IMATH_LIBRARY}")
endif()

# How every Tsuya target is made: one library a layer, one package component a library.

option(TSUYA_WARNINGS_AS_ERRORS "Treat compiler warnings as errors" OFF)
option(TSUYA_SANITIZE "Build with the address and undefined-behaviour sanitizers" OFF)

# Language level, warnings and sanitizers of one target.
function(tsuya_target_defaults target)
    target_compile_features(${target} PUBLIC cxx_std_20)
    set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wconversion -Wshadow
        # g++ 12 sees overlaps in std::string that are not there (GCC bug 105651)
        $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
        $<$<BOOL:${TSUYA_WARNINGS_AS_ERRORS}>:-Werror>)
    if(TSUYA_SANITIZE)
        # OpenSubdiv is built without run-time type information: no vptr check.
        # Instrumented std::regex looks uninitialised to g++ 12.
        set(flags -fsanitize=address,undefined -fno-sanitize=vptr -fno-sanitize-recover=undefined
            -fno-omit-frame-pointer $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
        target_compile_options(${target} PRIVATE ${flags})
        # The sanitizer calls dlopen in our place, so the run path must be one for all callers.
        target_link_options(${target} PRIVATE ${flags} LINKER:--disable-new-dtags)
    endif()
endfunction()

# Square roots become one instruction; no value changes.
function(tsuya_numeric_flags target)
    target_compile_options(${target} PRIVATE -fno-math-errno -fno-trapping-math)
endfunction()

# tsuya_add_library(<component> NUMERIC HEADERS <public headers> SOURCES <sources>)
# makes the target tsuya_<component> with the alias tsuya::<component>, installed as a package
# component of that name. Headers are given relative to <folder>/include; sources include what is
# theirs alone relative to <folder>/src. NUMERIC may be left out, see tsuya_numeric_flags.
function(tsuya_add_library component)
    cmake_parse_arguments(ARG "NUMERIC" "" "" ${ARGN})
    set(target tsuya_${component})
    add_library(${target} STATIC)
    add_library(tsuya::${component} ALIAS ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${component})
    tsuya_target_defaults(${target})
    if(ARG_NUMERIC)
        tsuya_numeric_flags(${target})
        tsuya_precompile(${target} numeric)
    else()
        tsuya_precompile(${target} library)
    endif()
    tsuya_add_to_library(${component} ${ARG_UNPARSED_ARGUMENTS})
    install(TARGETS ${target} EXPORT tsuya_${component}_targets COMPONENT ${component}
            FILE_SET HEADERS)
    set_property(GLOBAL APPEND PROPERTY TSUYA_COMPONENTS ${component})
endfunction()

# tsuya_add_to_library(<component> HEADERS <public headers> SOURCES <sources>)
# adds the headers and sources of one more folder.
function(tsuya_add_to_library component)
    cmake_parse_arguments(ARG "" "" "HEADERS;SOURCES" ${ARGN})
    list(TRANSFORM ARG_HEADERS PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/include/")
    list(TRANSFORM ARG_SOURCES PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/")
    target_sources(tsuya_${component}
        PUBLIC FILE_SET HEADERS BASE_DIRS "${CMAKE_CURRENT_SOURCE_DIR}/include" FILES ${ARG_HEADERS}
        PRIVATE ${ARG_SOURCES})
    target_include_directories(tsuya_${component} PRIVATE "${CMAKE_CURRENT_SOURCE_DIR}/src")
endfunction()

# tsuya_add_sum(<component> <components>...) makes a component of several others.
function(tsuya_add_sum component)
    set(target tsuya_${component})
    add_library(${target} INTERFACE)
    add_library(tsuya::${component} ALIAS ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${component})
    list(TRANSFORM ARGN PREPEND "tsuya::")
    target_link_libraries(${target} INTERFACE ${ARGN})
    install(TARGETS ${target} EXPORT tsuya_${component}_targets COMPONENT ${component})
    set_property(GLOBAL APPEND PROPERTY TSUYA_COMPONENTS ${component})
endfunction()

# tsuya_add_program(<name> <sources>...) puts the program into <build>/bin.
function(tsuya_add_program name)
    add_executable(${name} ${ARGN})
    tsuya_target_defaults(${name})
    set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
endfunction()

# tsuya_add_parts(<name> <sources>...) makes a library of sources that several programs share.
function(tsuya_add_parts name)
    add_library(${name} STATIC ${ARGN})
    tsuya_target_defaults(${name})
    tsuya_program_flags(${name})
endfunction()

# The code model of a program, for what is linked into programs alone.
function(tsuya_program_flags target)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    target_compile_options(${target} PRIVATE -fPIE)
endfunction()

# For code that parses, calls libraries and prints: it is compiled faster and runs as fast.
function(tsuya_light_flags target)
    target_compile_options(${target} PRIVATE -O1)
endfunction()

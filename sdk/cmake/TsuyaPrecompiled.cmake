# Headers of the standard library and GLM, compiled once for each set of flags. They are a third of a
# clean build. Off where a compiler launcher keeps results (ccache has no use for them, and shows
# includes that are missing), and for compilers on which they were not tried.
set(precompile ${PROJECT_IS_TOP_LEVEL})
if(CMAKE_CXX_COMPILER_LAUNCHER OR NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    set(precompile OFF)
endif()
option(TSUYA_PRECOMPILE_HEADERS "Compile common headers once" ${precompile})

# tsuya_precompile(<target> <kind>): the headers for a target of the kind
#   library   of tsuya_add_library
#   numeric   the same, NUMERIC
#   program   with tsuya_light_flags
#   test      of tsuya_add_test, or what is linked into some
# The flags of a target beside its kind's must not change what the headers mean.
function(tsuya_precompile target kind)
    if(NOT TSUYA_PRECOMPILE_HEADERS)
        return()
    endif()
    set(owner tsuya_precompiled_${kind})
    if(NOT TARGET ${owner})
        tsuya_add_precompiled(${owner} ${kind})
    endif()
    target_precompile_headers(${target} REUSE_FROM ${owner})
    # g++ forgets that precompiled lines are the system's, and warns of its own std::string (GCC bug
    # 105651 again). Builds without precompiled headers have these warnings.
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow)
endfunction()

function(tsuya_add_precompiled owner kind)
    set(source "${PROJECT_BINARY_DIR}/${owner}.cpp")
    file(WRITE "${source}" "// A target needs a source.\n")
    add_library(${owner} OBJECT "${source}")
    tsuya_target_defaults(${owner})
    find_package(glm REQUIRED)
    target_link_libraries(${owner} PRIVATE glm::glm)
    set(headers <algorithm> <array> <cmath> <filesystem> <functional> <iostream> <map> <numeric>
        <optional> <random> <span> <sstream> <string> <vector> <glm/glm.hpp>)
    if(kind STREQUAL numeric)
        tsuya_numeric_flags(${owner})
    elseif(NOT kind STREQUAL library)
        tsuya_program_flags(${owner})
    endif()
    if(kind STREQUAL program OR kind STREQUAL test)
        tsuya_light_flags(${owner})
    endif()
    if(kind STREQUAL test)
        find_package(nlohmann_json REQUIRED)
        target_link_libraries(${owner} PRIVATE GTest::gtest nlohmann_json::nlohmann_json)
        list(APPEND headers <gtest/gtest.h> <nlohmann/json.hpp>)
    endif()
    target_precompile_headers(${owner} PRIVATE ${headers})
endfunction()

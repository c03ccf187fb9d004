# Installs the package and builds a project against each of its components.
# cmake -DBUILD=<build tree> -DCONSUMER=<tests/consumer> -DSCRATCH=<folder> -DCOMPONENTS=<a,b>
#       -DCOMPILER=<C++ compiler> -DSOURCE=<repository> -P package_test.cmake
cmake_minimum_required(VERSION 3.24)
string(REPLACE "," ";" COMPONENTS "${COMPONENTS}")
set(prefix "${SCRATCH}/prefix")
file(REMOVE_RECURSE "${SCRATCH}")

# run(<what it is for> <command>...) fails the test with the command's output.
function(run what)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE out)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "${what}: status ${status}\n${out}")
    endif()
    message(STATUS "${what}: done")
endfunction()

# configure(<status variable> <output variable> <component>)
function(configure status_name out_name component)
    execute_process(
        COMMAND ${CMAKE_COMMAND} -S "${CONSUMER}" -B "${SCRATCH}/${component}" -G Ninja
                -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_COMPILER=${COMPILER}"
                "-DCMAKE_PREFIX_PATH=${prefix}" -DTSUYA_COMPONENT=${component}
        RESULT_VARIABLE status OUTPUT_VARIABLE out ERROR_VARIABLE out)
    set(${status_name} ${status} PARENT_SCOPE)
    set(${out_name} "${out}" PARENT_SCOPE)
endfunction()

foreach(component IN LISTS COMPONENTS ITEMS package)
    run("install ${component}"
        ${CMAKE_COMMAND} --install "${BUILD}" --prefix "${prefix}" --component ${component})
endforeach()

# The package can be moved: it names neither the build tree nor the sources.
file(GLOB_RECURSE package_files "${prefix}/*.cmake" "${prefix}/*.pc")
foreach(package_file IN LISTS package_files)
    file(READ "${package_file}" text)
    foreach(place IN ITEMS "${BUILD}" "${SOURCE}/")
        string(FIND "${text}" "${place}" found)
        if(NOT found EQUAL -1)
            message(FATAL_ERROR "${package_file} names ${place}")
        endif()
    endforeach()
endforeach()
list(LENGTH package_files count)
if(count LESS 3)
    message(FATAL_ERROR "the package has only the files: ${package_files}")
endif()

foreach(component IN LISTS COMPONENTS)
    # sdk is used by the program of render, its topmost part
    if(NOT component STREQUAL "sdk" AND NOT EXISTS "${CONSUMER}/${component}.cpp")
        message(FATAL_ERROR "the component '${component}' needs a user: ${CONSUMER}/${component}.cpp")
    endif()
    configure(status out ${component})
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "configure a user of ${component}: ${out}")
    endif()
    run("build a user of ${component}" ${CMAKE_COMMAND} --build "${SCRATCH}/${component}")
    run("run a user of ${component}" "${SCRATCH}/${component}/consumer")
endforeach()

# The same with pkg-config alone. Between them these two use every library.
file(GLOB_RECURSE pc_file "${prefix}/*/tsuya-values.pc")
cmake_path(GET pc_file PARENT_PATH pc_folder)
set(ENV{PKG_CONFIG_PATH} "${pc_folder}")
foreach(component IN ITEMS scene lab)
    execute_process(COMMAND pkg-config --cflags --libs tsuya-${component}
        RESULT_VARIABLE status OUTPUT_VARIABLE flags ERROR_VARIABLE out)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "pkg-config of ${component}: ${out}")
    endif()
    separate_arguments(flags UNIX_COMMAND "${flags}")
    set(user "${SCRATCH}/${component}-pkg-config")
    run("build a user of ${component} with pkg-config"
        "${COMPILER}" -std=c++20 "${CONSUMER}/${component}.cpp" -o "${user}" ${flags})
    run("run a user of ${component} with pkg-config" "${user}")
endforeach()

# A component that does not exist is refused with the names of those that do.
configure(status out colour)
if(status EQUAL 0 OR NOT out MATCHES "no component 'colour'; it has:")
    message(FATAL_ERROR "the component 'colour' was not refused: ${out}")
endif()
file(REMOVE_RECURSE "${SCRATCH}")

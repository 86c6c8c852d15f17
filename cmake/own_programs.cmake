# SPDX-License-Identifier: MIT
# Flags for tests, examples and benchmarks. They are folder properties, so that nothing reaches a
# user through the targets of sivid.

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_CXX_EXTENSIONS OFF)

find_program(SIVID_CCACHE ccache)
mark_as_advanced(SIVID_CCACHE)
if(SIVID_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER "${SIVID_CCACHE}")
endif()

if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    add_compile_options(-Wall -Wextra -Wpedantic -Wconversion -Wshadow)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
        add_compile_options(-Wno-restrict)   # false alarms on "literal" + std::string (GCC bug 105651)
    endif()
    if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 22)
        add_compile_options(-Wno-c2y-extensions)   # Catch2's macros use __COUNTER__
    endif()
    if(SIVID_WERROR)
        add_compile_options(-Werror)
    endif()
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        # No garbage collection below 1 GB: less time for more memory.
        add_compile_options(--param=ggc-min-heapsize=1048576)
    endif()
    if(SIVID_NATIVE)
        add_compile_options(-march=native)
        if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
            add_compile_options(-Wno-maybe-uninitialized -Wno-uninitialized)   # g++ 12 about its own AVX-512 headers
        endif()
    endif()
    if(SIVID_SANITIZE)
        add_compile_definitions(SIVID_SANITIZED)   # some tests wait longer
        add_compile_options(-fsanitize=${SIVID_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
        add_link_options(-fsanitize=${SIVID_SANITIZE})
        if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
            add_compile_options(-Wno-maybe-uninitialized)   # false alarms in instrumented code (GCC documents this)
        endif()
    endif()
endif()

add_compile_definitions("SIVID_SOURCE_DIR=\"${PROJECT_SOURCE_DIR}\"")
# Tests of records that are not part of the repository, since nobody licensed them, are skipped where the folder lacks them.
get_filename_component(sivid_measured "${PROJECT_SOURCE_DIR}/../shared/data" ABSOLUTE)
set(SIVID_MEASURED_DATA "${sivid_measured}" CACHE PATH
    "Folder with the records of measured machines, emps and cascaded_tanks (docs/machines.md)")
add_compile_definitions("SIVID_MEASURED_DATA=\"${SIVID_MEASURED_DATA}\"")

# sivid_add_folders(<folder>): adds each sub-folder that has a CMakeLists.txt.
function(sivid_add_folders folder)
    file(GLOB lists CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${folder}/*/CMakeLists.txt")
    foreach(list IN LISTS lists)
        get_filename_component(child "${list}" DIRECTORY)
        file(RELATIVE_PATH relative "${PROJECT_SOURCE_DIR}" "${child}")
        add_subdirectory("${relative}")
    endforeach()
endfunction()

set(SIVID_UNOPTIMISED "" CACHE STRING
    "Floors of the tests, and examples, to compile at -O0: they call the library, and most of their time is the compiler's")

set(SIVID_UNOPTIMISED_PARTS "" CACHE STRING
    "Parts of the compiled library to compile at -O0: they hardly compute, and take the compiler a third of the time then")
set(SIVID_OPTIMISED_PARTS "" CACHE STRING
    "Parts of the compiled library to compile at -O2 whatever the others are: programs spend most of their time in them")
option(SIVID_JOIN_PARTS
    "Compile those parts in one source that are optimised alike: three quarters of the time for who does it once" OFF)
mark_as_advanced(SIVID_UNOPTIMISED SIVID_UNOPTIMISED_PARTS SIVID_OPTIMISED_PARTS SIVID_JOIN_PARTS)

function(sivid_leave_unoptimised target)
    target_compile_options(${target} PRIVATE -O0)
endfunction()

# sivid_leave_folder_unoptimised(<folder>): its targets and those of the folders in it.
function(sivid_leave_folder_unoptimised folder)
    get_property(targets DIRECTORY "${folder}" PROPERTY BUILDSYSTEM_TARGETS)
    foreach(target IN LISTS targets)
        get_target_property(type ${target} TYPE)
        if(type MATCHES "EXECUTABLE|_LIBRARY" AND NOT type MATCHES "INTERFACE")
            sivid_leave_unoptimised(${target})
        endif()
    endforeach()
    get_property(children DIRECTORY "${folder}" PROPERTY SUBDIRECTORIES)
    foreach(child IN LISTS children)
        sivid_leave_folder_unoptimised("${child}")
    endforeach()
endfunction()

# SPDX-License-Identifier: MIT
# sivid_compile_in_batches(<target> <source>...): compiles the sources of a target several at a time, since most of the
# time goes into what they include. Each stands in a namespace of its own, so that their local names do not meet; what
# they include therefore stands first, outside of it. Sources that define macros or specialise templates are left alone.

option(SIVID_BATCHES "Compile tests in batches: a third of the time; off, each source is an object of its own" ON)

function(sivid_compile_in_batches target)
    if(NOT SIVID_BATCHES)
        return()
    endif()
    set(prelude "// What the sources of ${target} include, under their conditions.\n#pragma once\n")
    foreach(source IN LISTS ARGN)
        get_filename_component(source "${source}" ABSOLUTE)
        file(STRINGS "${source}" alone REGEX "^#define|^#if.*[\\]$|^template ?<>|^(inline )?namespace [a-z_:]+ {" LIMIT_COUNT 1)
        if(alone)
            set_source_files_properties("${source}" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
            continue()
        endif()
        get_filename_component(folder "${source}" DIRECTORY)
        # Brackets and semicolons are special in lists: lines are taken one by one from the text.
        file(READ "${source}" text)
        string(REGEX MATCHALL "\n#[ ]*(include|if|ifdef|ifndef|elif|else|endif)[^\n]*" lines "${text}")
        foreach(line IN LISTS lines)
            string(REGEX REPLACE ".*#include \"([^\"]+)\".*" "\\1" name "${line}")
            if(EXISTS "${folder}/${name}")
                string(REPLACE "\"${name}\"" "\"${folder}/${name}\"" line "${line}")
            endif()
            string(APPEND prelude "${line}")
        endforeach()
    endforeach()
    set(header "${CMAKE_CURRENT_BINARY_DIR}/${target}_includes.hpp")
    file(CONFIGURE OUTPUT "${header}" CONTENT "@prelude@\n" @ONLY)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${ARGN})
    set_target_properties(${target} PROPERTIES
        UNITY_BUILD ON
        UNITY_BUILD_BATCH_SIZE 12
        UNITY_BUILD_UNIQUE_ID sivid_source
        UNITY_BUILD_CODE_BEFORE_INCLUDE "#include \"${header}\"\nnamespace sivid_source {"
        UNITY_BUILD_CODE_AFTER_INCLUDE "}")
endfunction()

# SPDX-License-Identifier: MIT
# What only the preset `long` builds is configured, and the build files are read: of sources that moved the check would
# not learn otherwise. SOURCE, WORK, GENERATOR, COMPILER.
file(REMOVE_RECURSE "${WORK}")
foreach(step IN ITEMS configure read)
    if(step STREQUAL configure)
        set(command -S "${SOURCE}" -B "${WORK}" -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${COMPILER}"
            -DSIVID_LONG_TESTS=ON -DSIVID_BUILD_BENCHMARKS=ON)
    else()
        set(command --build "${WORK}" --target help)
    endif()
    execute_process(COMMAND "${CMAKE_COMMAND}" ${command} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
    if(NOT code EQUAL 0)
        message(FATAL_ERROR "${step}: ${code}\n${out}")
    endif()
endforeach()

# SPDX-License-Identifier: MIT
# Builds guard_probe.cpp with flags that break interval arithmetic; the compiler or the program must refuse.
#     cmake -DSOURCE=<repository> -DCOMPILER=<path> -DWORK=<folder> -P guard_flags.cmake
cmake_minimum_required(VERSION 3.22)
file(MAKE_DIRECTORY "${WORK}")
set(probe "${SOURCE}/tests/conformance/guard_probe.cpp")

function(outcome result)   # remaining arguments: flags of compiling, LINK, flags of linking
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "COMPILE;LINK")
    execute_process(COMMAND "${COMPILER}" -std=c++20 -O2 "-I${SOURCE}/include" ${arg_COMPILE} -c "${probe}"
                            -o "${WORK}/probe.o" RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
    if(NOT code EQUAL 0)
        if(out MATCHES "#error|error: \"sivid: |error: \"?sivid")
            set(${result} "refused by the compiler" PARENT_SCOPE)
        else()
            set(${result} "other error: ${out}" PARENT_SCOPE)
        endif()
        return()
    endif()
    execute_process(COMMAND "${COMPILER}" ${arg_LINK} "${WORK}/probe.o" -o "${WORK}/probe" COMMAND_ERROR_IS_FATAL ANY)
    execute_process(COMMAND "${WORK}/probe" OUTPUT_VARIABLE out)
    set(${result} "${out}" PARENT_SCOPE)
endfunction()

outcome(plain)
if(NOT plain MATCHES "^accepted")
    message(FATAL_ERROR "a sound build was not accepted: ${plain}")
endif()
foreach(flags IN ITEMS -ffast-math -ffinite-math-only -freciprocal-math -fno-signed-zeros
                       "-fassociative-math -fno-signed-zeros -fno-trapping-math")
    separate_arguments(list UNIX_COMMAND "${flags}")
    outcome(got COMPILE ${list})
    if(NOT got MATCHES "^refused")
        message(FATAL_ERROR "${flags}: ${got}")
    endif()
    message(STATUS "${flags}: ${got}")
endforeach()
outcome(linked LINK -ffast-math)
if(NOT linked MATCHES "^refused")
    message(FATAL_ERROR "linking with -ffast-math: ${linked}")
endif()
message(STATUS "linked with -ffast-math: ${linked}")

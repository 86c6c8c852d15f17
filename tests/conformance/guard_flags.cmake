# SPDX-License-Identifier: MIT
# Builds guard_probe.cpp with flags that break interval arithmetic; the compiler or the program must refuse.
#     cmake -DSOURCE=<repository> -DCOMPILER=<path> -DWORK=<folder> -P guard_flags.cmake
cmake_minimum_required(VERSION 3.22)
file(MAKE_DIRECTORY "${WORK}")
set(probe "${SOURCE}/tests/conformance/guard_probe.cpp")

# compile(<object> <flag>...): sets refused to who refuses it, or empty.
function(compile object)
    execute_process(COMMAND "${COMPILER}" -std=c++20 -O2 -Wfatal-errors "-I${SOURCE}/include" ${ARGN} -c "${probe}"
                            -o "${object}" RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
    set(refused "" PARENT_SCOPE)
    if(NOT code EQUAL 0)
        if(out MATCHES "#error|error: \"sivid: |error: \"?sivid")
            set(refused "refused by the compiler" PARENT_SCOPE)
        else()
            set(refused "other error: ${out}" PARENT_SCOPE)
        endif()
    endif()
endfunction()

# run_linked(<object> <flag of linking>...): sets said to what the program says.
function(run_linked object)
    execute_process(COMMAND "${COMPILER}" ${ARGN} "${object}" -o "${WORK}/probe" COMMAND_ERROR_IS_FATAL ANY)
    execute_process(COMMAND "${WORK}/probe" OUTPUT_VARIABLE out)
    set(said "${out}" PARENT_SCOPE)
endfunction()

compile("${WORK}/plain.o")
if(refused)
    message(FATAL_ERROR "a sound build was not accepted: ${refused}")
endif()
run_linked("${WORK}/plain.o")
if(NOT said MATCHES "^accepted")
    message(FATAL_ERROR "a sound build was not accepted: ${said}")
endif()
foreach(flags IN ITEMS -ffast-math -ffinite-math-only -freciprocal-math -fno-signed-zeros
                       "-fassociative-math -fno-signed-zeros -fno-trapping-math")
    separate_arguments(list UNIX_COMMAND "${flags}")
    compile("${WORK}/probe.o" ${list})
    set(got "${refused}")
    if(NOT refused)
        run_linked("${WORK}/probe.o")
        set(got "${said}")
    endif()
    if(NOT got MATCHES "^refused")
        message(FATAL_ERROR "${flags}: ${got}")
    endif()
    message(STATUS "${flags}: ${got}")
endforeach()
run_linked("${WORK}/plain.o" -ffast-math)   # the very object that was accepted
if(NOT said MATCHES "^refused")
    message(FATAL_ERROR "linking with -ffast-math: ${said}")
endif()
message(STATUS "linked with -ffast-math: ${said}")

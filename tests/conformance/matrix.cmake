# SPDX-License-Identifier: MIT
# Builds and runs the literal vectors, the run-time vectors and the code shapes for each compiler that is
# installed, at each optimisation level, native or not, with -frounding-math or not.
#     cmake -DSOURCE=<repository> -DVECTORS=<folder> -DLITERALS=<stem> -DPARTS=<n> -DWORK=<folder>
#           [-DCOMPILERS=g++;clang++] [-DLEVELS=-O0;-O2;-O3] -P matrix.cmake
cmake_minimum_required(VERSION 3.22)

if(NOT DEFINED COMPILERS)
    set(COMPILERS g++ clang++)
endif()
if(NOT DEFINED LEVELS)
    set(LEVELS -O0 -O2 -O3)
endif()
file(MAKE_DIRECTORY "${WORK}")

set(literal_sources "${LITERALS}_main.cpp")
math(EXPR last "${PARTS} - 1")
foreach(part RANGE ${last})
    list(APPEND literal_sources "${LITERALS}_${part}.cpp")
endforeach()
set(tests "${SOURCE}/tests/conformance")

function(run_or_stop what)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
    if(NOT code EQUAL 0)
        message(FATAL_ERROR "${what} failed:\n${out}")
    endif()
endfunction()

set(count 0)
foreach(compiler IN LISTS COMPILERS)
    find_program(found_${compiler} ${compiler})
    if(NOT found_${compiler})
        message(STATUS "skipped: ${compiler} is not installed")
        continue()
    endif()
    foreach(level IN LISTS LEVELS)
        foreach(machine IN ITEMS "" -march=native -march=x86-64-v3)
            foreach(rounding IN ITEMS "" -frounding-math)
                set(flags -std=c++20 ${level} ${machine} ${rounding} "-I${SOURCE}/include" "-I${SOURCE}/tests"
                          "-DSIVID_SHARED_DIR=\"${VECTORS}/..\"" "-DSIVID_LITERAL_TYPE=sivid::interval"
                          "-DSIVID_LITERAL_HEADER=<sivid/number/interval_traits.hpp>")
                set(name "${compiler} ${level} ${machine} ${rounding}")
                run_or_stop("${name}: compiling literals"
                            ${compiler} ${flags} ${literal_sources} -o "${WORK}/literals")
                run_or_stop("${name}: literals" "${WORK}/literals")
                run_or_stop("${name}: compiling shapes" ${compiler} ${flags} "${SOURCE}/tests/main.cpp"
                            "${tests}/vectors.test.cpp" "${tests}/shapes.test.cpp" "${tests}/shapes_elsewhere.cpp"
                            -lmpfr -lgmp -pthread -o "${WORK}/shapes")
                run_or_stop("${name}: shapes" "${WORK}/shapes")
                math(EXPR count "${count} + 1")
                message(STATUS "${name}: contained")
            endforeach()
        endforeach()
    endforeach()
endforeach()
if(count EQUAL 0)
    message(FATAL_ERROR "no compiler was found")
endif()
message(STATUS "${count} configurations, no failure")

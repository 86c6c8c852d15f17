# SPDX-License-Identifier: MIT
# The run-time vectors, the literal vectors, the code shapes and the laws of every interval type, for each compiler that
# is installed, at each optimisation level, for this machine or any x86-64, with -frounding-math or not:
# 24 configurations, one line and its time each. Warnings are errors.
#     cmake -DSOURCE=<repository> -DLITERALS=<stem> -DPARTS=<n> -DWORK=<folder>
#           [-DCOMPILERS=g++;clang++] [-DLEVELS=-O0;-O2;-O3] [-DMACHINES=any;-march=native] -P matrix.cmake
cmake_minimum_required(VERSION 3.22)

if(NOT DEFINED COMPILERS)
    set(COMPILERS g++ clang++)
endif()
if(NOT DEFINED LEVELS)
    set(LEVELS -O0 -O2 -O3)
endif()
if(NOT DEFINED MACHINES)
    set(MACHINES any -march=native)
endif()
file(MAKE_DIRECTORY "${WORK}")
find_program(CCACHE ccache)
if(NOT CCACHE)
    set(CCACHE ${CMAKE_COMMAND} -E env)
endif()

set(warnings -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wno-restrict -Werror)
set(tests "${SOURCE}/tests/conformance")
set(libraries -lmpfi -lmpfr -lgmp -pthread)
set(vectors_per_type 7000)
math(EXPR last "${PARTS} - 1")
set(parts "${LITERALS}_main.cpp")
foreach(part RANGE ${last})
    list(APPEND parts "${LITERALS}_${part}.cpp")
endforeach()

function(run_or_stop what)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE out ERROR_VARIABLE out)
    if(NOT code EQUAL 0)
        message(FATAL_ERROR "${what} failed:\n${out}")
    endif()
    set(output "${out}" PARENT_SCOPE)
endfunction()

# build(<program> FLAGS <flag>... SOURCES <file>...), one object after the other.
function(build program)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "FLAGS;SOURCES")
    set(objects)
    foreach(source IN LISTS arg_SOURCES)
        get_filename_component(stem "${source}" NAME_WE)
        run_or_stop("${name}: compiling ${stem} of ${program}"
                    ${CCACHE} ${compiler} ${arg_FLAGS} -c "${source}" -o "${WORK}/${program}_${stem}.o")
        list(APPEND objects "${WORK}/${program}_${stem}.o")
    endforeach()
    run_or_stop("${name}: linking ${program}" ${compiler} ${objects} ${main_object} ${libraries} -o "${WORK}/${program}")
endfunction()

# literals(<type> <header> <expected flags> SOURCES...): builds and runs the literal vectors of a type.
function(literals program type header)
    set(main_object)
    build(${program} FLAGS ${flags} "-DSIVID_LITERAL_TYPE=${type}" "-DSIVID_LITERAL_HEADER=<${header}>" ${ARGN}
          SOURCES ${literal_sources})
    run_or_stop("${name}: ${program}" "${WORK}/${program}")
    if(NOT output MATCHES "([0-9]+) literal vectors, 0 unsound" OR CMAKE_MATCH_1 LESS vectors_per_type)
        message(FATAL_ERROR "${name}: ${program}: ${output}")
    endif()
endfunction()

set(count 0)
string(TIMESTAMP first "%s")
foreach(compiler IN LISTS COMPILERS)
    find_program(found_${compiler} ${compiler})
    if(NOT found_${compiler})
        message(STATUS "left out: ${compiler} is not installed")
        continue()
    endif()
    # Not every compiler knows the flag; one that warns ignores it.
    set(roundings none -frounding-math)
    file(WRITE "${WORK}/empty.cpp" "int main() { return 0; }\n")
    execute_process(COMMAND ${compiler} -Werror -frounding-math -c "${WORK}/empty.cpp" -o "${WORK}/empty.o"
                    RESULT_VARIABLE code OUTPUT_QUIET ERROR_QUIET)
    if(NOT code EQUAL 0)
        set(roundings none)
        message(STATUS "left out: ${compiler} ignores -frounding-math")
    endif()
    set(name "${compiler}")
    set(catch_main "${WORK}/main_${compiler}.o")
    run_or_stop("${compiler}: test main" ${CCACHE} ${compiler} -std=c++20 -O1 -w -c "${SOURCE}/tests/main.cpp"
                -o "${catch_main}")
    foreach(level IN LISTS LEVELS)
        foreach(machine IN LISTS MACHINES)
            foreach(rounding IN LISTS roundings)
                string(TIMESTAMP start "%s")
                set(name "${compiler} ${level} ${machine} ${rounding}")
                set(flags -std=c++20 ${level} ${warnings} "-I${SOURCE}/include" "-I${SOURCE}/tests"
                          -DSIVID_HAS_MPFR=1 -DSIVID_HAS_MPFI=1)
                if(compiler MATCHES "clang")
                    list(APPEND flags -Wno-unknown-warning-option)   # -Wno-restrict is for g++ 12
                endif()
                if(NOT machine STREQUAL "any")
                    list(APPEND flags ${machine})
                endif()
                if(NOT rounding STREQUAL "none")
                    list(APPEND flags ${rounding})
                endif()

                set(literal_sources ${parts})
                literals(interval sivid::interval sivid/number/interval_traits.hpp)
                literals(pack8 "sivid::pack<8>" support/pack_functions.hpp)
                set(literal_sources "${LITERALS}_one_main.cpp" "${LITERALS}_one_0.cpp")
                literals(mp_interval sivid::mp_interval sivid/number/mp_interval.hpp -DSIVID_LITERAL_CALLS)

                set(main_object "${catch_main}")
                build(shapes FLAGS ${flags} "-DSIVID_SOURCE_DIR=\"${SOURCE}\""
                      SOURCES "${tests}/vectors.test.cpp" "${tests}/shapes.test.cpp" "${tests}/shapes_elsewhere.cpp"
                              "${SOURCE}/tests/laws/laws.test.cpp")
                run_or_stop("${name}: vectors and shapes" "${WORK}/shapes")

                string(TIMESTAMP stop "%s")
                math(EXPR seconds "${stop} - ${start}")
                math(EXPR count "${count} + 1")
                message(STATUS "${name}: contained (${seconds} s)")
            endforeach()
        endforeach()
    endforeach()
endforeach()
if(count EQUAL 0)
    message(FATAL_ERROR "no compiler was found")
endif()
string(TIMESTAMP stop "%s")
math(EXPR seconds "${stop} - ${first}")
message(STATUS "${count} configurations, no failure (${seconds} s)")

# SPDX-License-Identifier: MIT
# Parses each of HEADERS (separated by |) as if it were alone (header_chains.cmake), and as if what may be compiled once
# were: a header has to name all that it declares with, and a file of definitions all that it needs beside its header.
# Where nothing is compiled once both come together; that no order of them is a cycle is a rule of tests/architecture.
# Of the units every one whose number leaves PART when divided by PARTS.
# The line after the includes is wrong: the compiler has to get there, and stops there, before it instantiates what the
# header only defines (three quarters of the time).
cmake_minimum_required(VERSION 3.22)

string(REPLACE "|" ";" headers "${HEADERS}")
include("${CMAKE_CURRENT_LIST_DIR}/header_chains.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/system_folders.cmake")
system_folders(options "${FOLDERS}")
list(PREPEND options -std=c++20 -DSIVID_COMPILED -DSIVID_COMPILED_MPFI -fsyntax-only -Wfatal-errors -w)
file(MAKE_DIRECTORY "${WORK}")
# The standard library and Eigen are read once (half the time). That no header lives on what they bring is a rule of
# tests/architecture; with NOTHING_BEFORE nothing at all stands before a header.
if(NOT NOTHING_BEFORE)
    set(common "")
    foreach(header algorithm array atomic charconv chrono cmath cstddef cstdint filesystem functional limits map memory
            mutex numeric optional random set stdexcept string string_view tuple type_traits utility variant vector
            Eigen/Core)
        string(APPEND common "#include <${header}>\n")
    endforeach()
    file(WRITE "${WORK}/common.hpp" "${common}")
    list(REMOVE_ITEM options -fsyntax-only)
    execute_process(COMMAND "${COMPILER}" ${options} -x c++-header "${WORK}/common.hpp" -o "${WORK}/common.hpp.gch"
                    COMMAND_ERROR_IS_FATAL ANY)
    list(APPEND options -fsyntax-only -include "${WORK}/common.hpp")
endif()
set(units "${headers}")
if(NOT NOTHING_BEFORE)
    string(REGEX REPLACE "[|].*" "" folder "${FOLDERS}")
    header_chains(units "${folder}" ${headers})
endif()
set(number 0)
foreach(unit IN LISTS units)
    math(EXPR number "(${number} + 1) % ${PARTS}")
    if(NOT number EQUAL PART)
        continue()
    endif()
    string(REPLACE "|" ">\n#include <" includes "${unit}")
    file(WRITE "${WORK}/alone.cpp" "#include <${includes}>\nstatic_assert(false, \"end of the headers\");\n")
    execute_process(COMMAND "${COMPILER}" ${options} "${WORK}/alone.cpp" ERROR_VARIABLE text OUTPUT_QUIET)
    if(NOT text MATCHES "alone.cpp:[0-9]+:[^\n]*error[^\n]*end of the headers")
        message(SEND_ERROR "one of these does not compile alone:\n#include <${includes}>\n${text}")
    endif()
endforeach()

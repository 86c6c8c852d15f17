# SPDX-License-Identifier: MIT
# Parses each of HEADERS (separated by |) with nothing before it, as if what may be compiled once were: a header has to
# name all that it declares with, and a file of definitions all that it needs beside its header. Where nothing is
# compiled once both come together; that no order of them is a cycle is a rule of tests/architecture.
# The line after the include is wrong: the compiler has to get there, and stops there, before it instantiates what the
# header only defines (three quarters of the time).
cmake_minimum_required(VERSION 3.22)

string(REPLACE "|" ";" headers "${HEADERS}")
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
            Eigen/Cholesky Eigen/Core Eigen/LU Eigen/QR)
        string(APPEND common "#include <${header}>\n")
    endforeach()
    file(WRITE "${WORK}/common.hpp" "${common}")
    list(REMOVE_ITEM options -fsyntax-only)
    execute_process(COMMAND "${COMPILER}" ${options} -x c++-header "${WORK}/common.hpp" -o "${WORK}/common.hpp.gch"
                    COMMAND_ERROR_IS_FATAL ANY)
    list(APPEND options -fsyntax-only -include "${WORK}/common.hpp")
endif()
foreach(header IN LISTS headers)
    file(WRITE "${WORK}/alone.cpp" "#include <${header}>\nstatic_assert(false, \"end of the header\");\n")
    execute_process(COMMAND "${COMPILER}" ${options} "${WORK}/alone.cpp" ERROR_VARIABLE text OUTPUT_QUIET)
    if(NOT text MATCHES "alone.cpp:2:[^\n]*error[^\n]*end of the header")
        message(SEND_ERROR "<${header}> does not compile alone:\n${text}")
    endif()
endforeach()

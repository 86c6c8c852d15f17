# SPDX-License-Identifier: MIT
# Parses each of HEADERS (separated by |) with nothing before it. The line after the include is wrong: the compiler has
# to get there, and stops there, before it instantiates what the header only defines (three quarters of the time).
# What defines nothing that may be compiled once is parsed as if all that were: fewer headers come with it then, so
# that it has to name more itself, and in half of the time.
cmake_minimum_required(VERSION 3.22)

string(REPLACE "|" ";" headers "${HEADERS}")
string(REPLACE "|" ";" folders "${FOLDERS}")
set(options -std=c++20 -fsyntax-only -Wfatal-errors -w)
foreach(folder IN LISTS folders)
    if(folder AND NOT folder STREQUAL "/usr/include")
        list(APPEND options -isystem "${folder}")
    endif()
endforeach()
file(MAKE_DIRECTORY "${WORK}")
foreach(header IN LISTS headers)
    file(WRITE "${WORK}/alone.cpp" "#include <${header}>\nstatic_assert(false, \"end of the header\");\n")
    file(READ "${INCLUDE}/${header}" text)
    set(mode -DSIVID_COMPILED -DSIVID_COMPILED_MPFI)
    if(text MATCHES "SIVID_DECL|SIVID_COMPIL")
        set(mode "")
    endif()
    execute_process(COMMAND "${COMPILER}" ${options} ${mode} "${WORK}/alone.cpp" ERROR_VARIABLE text OUTPUT_QUIET)
    if(NOT text MATCHES "alone.cpp:2:[^\n]*error[^\n]*end of the header")
        message(SEND_ERROR "<${header}> does not compile alone:\n${text}")
    endif()
endforeach()

# SPDX-License-Identifier: MIT
# The programs, separated by |, each with its arguments, say the same with libsivid of BUILD for every x86-64 machine and
# with that of each of the LEVELS (separated by |) that this machine has; and the loader takes the highest of these.
cmake_minimum_required(VERSION 3.22)

string(REPLACE "|" ";" levels "${LEVELS}")
string(REPLACE "|" ";" programs "${PROGRAMS}")
execute_process(COMMAND /lib64/ld-linux-x86-64.so.2 --help OUTPUT_VARIABLE machine COMMAND_ERROR_IS_FATAL ANY)

# say(<variable> <library> <program> <argument>...): what the program prints with that library.
function(say variable library)
    execute_process(COMMAND "${CMAKE_COMMAND}" -E env "LD_PRELOAD=${library}" ${ARGN}
                    OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
    set(${variable} "${text}" PARENT_SCOPE)
endfunction()

set(best "")
foreach(level IN LISTS levels)
    if(machine MATCHES "${level} [(]supported")
        set(best "${level}")
    else()
        message("test skipped: this machine is not ${level}")
    endif()
endforeach()
foreach(line IN LISTS programs)
    separate_arguments(command UNIX_COMMAND "${line}")
    say(expected "${BUILD}/libsivid.so.0" ${command})
    if(expected STREQUAL "")
        message(FATAL_ERROR "${line} says nothing")
    endif()
    foreach(level IN LISTS levels)
        if(machine MATCHES "${level} [(]supported")
            say(text "${BUILD}/glibc-hwcaps/${level}/libsivid.so.0" ${command})
            if(NOT text STREQUAL expected)
                message(SEND_ERROR "${line} says for ${level}\n${text}\nand for any machine\n${expected}")
            endif()
        endif()
    endforeach()
    list(GET command 0 program)
    execute_process(COMMAND "${CMAKE_COMMAND}" -E env LD_TRACE_LOADED_OBJECTS=1 "${program}" OUTPUT_VARIABLE loaded)
    if(best AND NOT loaded MATCHES "libsivid[.]so[.]0 => [^\n]*/glibc-hwcaps/${best}/")
        message(SEND_ERROR "the loader does not take ${best}:\n${loaded}")
    endif()
endforeach()

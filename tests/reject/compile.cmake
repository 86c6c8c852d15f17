# SPDX-License-Identifier: MIT
# Compiles FILE with SIVID_REJECT=VARIANT; succeeds when variant 0 compiles, or when another variant fails with
# the message that its head line names. Without FILE: reads HEADERS, what a file includes, for its variants.
set(flags -std=c++20)
string(REPLACE "|" ";" include_list "${INCLUDES}")
foreach(folder IN LISTS include_list)
    list(APPEND flags -I "${folder}")
endforeach()
set(ENV{LC_ALL} C)
if(NOT FILE)
    execute_process(COMMAND "${COMPILER}" ${flags} -x c++-header "${HEADERS}" -o "${HEADERS}.gch"
                    COMMAND_ERROR_IS_FATAL ANY)
    return()
endif()
list(APPEND flags -fsyntax-only "-DSIVID_REJECT=${VARIANT}")
if(HEADERS)
    list(APPEND flags -include "${HEADERS}")   # the compiler takes the file beside it, if that is as it would read them
endif()
execute_process(COMMAND "${COMPILER}" ${flags} "${FILE}" RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE text)

if(VARIANT EQUAL 0)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "must compile, but:\n${text}")
    endif()
    return()
endif()

file(STRINGS "${FILE}" head REGEX "^// reject ${VARIANT}: ")
string(REGEX REPLACE "^// reject [0-9]+: " "" expected "${head}")
if(expected STREQUAL "")
    message(FATAL_ERROR "no line '// reject ${VARIANT}: <message>' in ${FILE}")
elseif(status EQUAL 0)
    message(FATAL_ERROR "compiles, but must be rejected with: ${expected}")
elseif(NOT text MATCHES "${expected}")
    message(FATAL_ERROR "rejected, but not with '${expected}':\n${text}")
endif()

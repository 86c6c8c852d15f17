# SPDX-License-Identifier: MIT
# Links a program that uses sivid's matrices to the library COMPILED, which was built with FLAGS: with the same flags
# it must link, with others, or by the OTHER compiler, the linker must name what differs.
cmake_minimum_required(VERSION 3.22)

file(MAKE_DIRECTORY "${WORK}")
file(WRITE "${WORK}/program.cpp" "#include <sivid/space/matrix.hpp>\nint main() {}\n")
separate_arguments(flags UNIX_COMMAND "${FLAGS}")
include("${CMAKE_CURRENT_LIST_DIR}/system_folders.cmake")
system_folders(options "${FOLDERS}")
list(PREPEND options -std=c++20 -DSIVID_COMPILED)

function(link_with)
    execute_process(COMMAND "${COMPILER}" ${options} ${ARGN} "${WORK}/program.cpp" "${COMPILED}" -o "${WORK}/program"
                    RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE text)
    set(status "${status}" PARENT_SCOPE)
    set(text "${text}" PARENT_SCOPE)
endfunction()
function(must_have_failed says)   # what link_with has just tried with the further arguments
    if(status EQUAL 0 OR NOT text MATCHES "undefined reference to [^\n]*${says}")
        message(SEND_ERROR "${ARGN}: no undefined reference to ${says}:\n${text}")
    endif()
endfunction()
function(must_fail says)
    link_with(${ARGN})
    must_have_failed(${says} ${ARGN})
endfunction()

foreach(level IN ITEMS -O0 "-O2;-DNDEBUG")   # levels and assertions may differ
    link_with(${flags} ${level})
    if(NOT status EQUAL 0)
        message(SEND_ERROR "${flags} ${level} does not link:\n${text}")
    endif()
endforeach()

set(machine sivid_compiled_has_other_machine_flags)
set(eigen sivid_compiled_has_another_eigen_alignment)
must_fail(${machine} ${flags} -D_GLIBCXX_DEBUG)
must_fail(${eigen} ${flags} -DEIGEN_DONT_ALIGN_STATICALLY)
must_fail(${eigen} ${flags} -DEIGEN_DEFAULT_TO_ROW_MAJOR)

if(OTHER)
    set(same "${COMPILER}")
    set(COMPILER "${OTHER}")
    must_fail(sivid_compiled_is_of_another_compiler ${flags} -O2)
    set(COMPILER "${same}")
endif()

# Of these three machines the library is for one at most; also where the linker drops unused sections.
set(linked 0)
foreach(level IN ITEMS x86-64 x86-64-v3 x86-64-v4)
    set(dropping ${flags} -march=${level} -O2 -ffunction-sections -fdata-sections -Wl,--gc-sections)
    link_with(${dropping})
    if(status EQUAL 0)
        math(EXPR linked "${linked} + 1")
    else()
        must_have_failed(${machine} ${dropping})
    endif()
endforeach()
if(linked GREATER 1)
    message(SEND_ERROR "programs for ${linked} machines link to one library")
endif()

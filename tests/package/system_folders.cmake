# SPDX-License-Identifier: MIT
# system_folders(VARIABLE LIST): compiler options for folders of others' headers, a list or parts joined by "|", without
# what every compiler looks through anyway.
function(system_folders variable folders)
    string(REPLACE "|" ";" folders "${folders}")
    set(options "")
    foreach(folder IN LISTS folders)
        if(folder AND NOT folder STREQUAL "/usr/include")
            list(APPEND options -isystem "${folder}")
        endif()
    endforeach()
    set(${variable} "${options}" PARENT_SCOPE)
endfunction()

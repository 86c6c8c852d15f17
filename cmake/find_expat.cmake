# SPDX-License-Identifier: MIT
# What sivid::xml links to, in sivid_expat_libraries; empty where it is not installed.

set(sivid_expat_libraries "")
find_path(SIVID_EXPAT_INCLUDE expat.h)
find_library(SIVID_EXPAT expat)
mark_as_advanced(SIVID_EXPAT_INCLUDE SIVID_EXPAT)
if(SIVID_EXPAT_INCLUDE AND SIVID_EXPAT)
    if(NOT TARGET sivid_expat::expat)   # by a name in the package files, which then hold for any machine
        add_library(sivid_expat::expat UNKNOWN IMPORTED)
        set_target_properties(sivid_expat::expat PROPERTIES IMPORTED_LOCATION "${SIVID_EXPAT}"
                              INTERFACE_INCLUDE_DIRECTORIES "${SIVID_EXPAT_INCLUDE}")
    endif()
    set(sivid_expat_libraries sivid_expat::expat)
endif()

# SPDX-License-Identifier: MIT
# What sivid::matlab links to, in sivid_matio_libraries; empty where it is not installed.

set(sivid_matio_libraries "")
find_path(SIVID_MATIO_INCLUDE matio.h)
find_library(SIVID_MATIO matio)
mark_as_advanced(SIVID_MATIO_INCLUDE SIVID_MATIO)
find_package(ZLIB QUIET)
if(SIVID_MATIO_INCLUDE AND SIVID_MATIO AND ZLIB_FOUND)
    if(NOT TARGET matio::matio)   # by its name in the package files, which then hold for any machine
        add_library(matio::matio UNKNOWN IMPORTED)
        set_target_properties(matio::matio PROPERTIES IMPORTED_LOCATION "${SIVID_MATIO}"
                              INTERFACE_INCLUDE_DIRECTORIES "${SIVID_MATIO_INCLUDE}")
    endif()
    set(sivid_matio_libraries matio::matio ZLIB::ZLIB)
endif()

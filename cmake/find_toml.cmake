# SPDX-License-Identifier: MIT
# Where toml++ lies, which sivid::text needs, in sivid_toml_include; empty where it is not installed.

set(sivid_toml_include "")
find_path(SIVID_TOML_INCLUDE toml++/toml.h)
mark_as_advanced(SIVID_TOML_INCLUDE)
if(SIVID_TOML_INCLUDE)
    if(NOT TARGET tomlplusplus::tomlplusplus)   # by its name in the package files, which then hold for any machine
        add_library(tomlplusplus::tomlplusplus INTERFACE IMPORTED)
        set_target_properties(tomlplusplus::tomlplusplus PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${SIVID_TOML_INCLUDE}")
    endif()
    set(sivid_toml_include "${SIVID_TOML_INCLUDE}")
endif()

# SPDX-License-Identifier: MIT
# sivid_write_version_file(<file> <version>): which versions of the package answer a request, by Semantic Versioning.
# From 1.0 on all that have the same major number and are not older; before, minor numbers may break users.

include(CMakePackageConfigHelpers)

function(sivid_write_version_file file version)
    set(rule SameMajorVersion)
    if(version MATCHES "^0\\.")
        set(rule SameMinorVersion)
    endif()
    write_basic_package_version_file("${file}" VERSION "${version}" COMPATIBILITY ${rule} ARCH_INDEPENDENT)
endfunction()

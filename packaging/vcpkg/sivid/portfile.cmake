# SPDX-License-Identifier: MIT
# A port of the clone in which it lies: vcpkg install sivid --overlay-ports=<clone>/packaging/vcpkg
# In a registry vcpkg_from_github(... REF v${VERSION} ...) takes the place of the next line.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

set(VCPKG_BUILD_TYPE release)   # headers only, or a library that serves all

set(options "")
if("library" IN_LIST FEATURES)
    list(APPEND options -DSIVID_LIBRARY=ON)
    set(VCPKG_POLICY_SKIP_MISPLACED_CMAKE_FILES_CHECK enabled)   # lib/cmake/sivid, which sividConfig.cmake reads
    set(VCPKG_POLICY_SKIP_LIB_CMAKE_MERGE_CHECK enabled)
    set(VCPKG_POLICY_MISMATCHED_NUMBER_OF_BINARIES enabled)      # one for release and debug
endif()

# What a feature does not ask for is not looked for, either.
list(APPEND options -DCMAKE_DISABLE_FIND_PACKAGE_MPI=ON)   # sivid::cluster is no feature here
list(APPEND options -DSIVID_WITH_MATIO=OFF)               # nor is sivid::matlab
list(APPEND options -DSIVID_WITH_EXPAT=OFF)               # nor is sivid::xml
list(APPEND options -DSIVID_WITH_URDF=OFF)                # nor is sivid::urdf
list(APPEND options -DSIVID_WITH_TOML=OFF)                # nor is sivid::text
foreach(feature_package IN ITEMS io:nlohmann_json parallel:TBB)
    string(REPLACE ":" ";" pair "${feature_package}")
    list(GET pair 0 feature)
    list(GET pair 1 package)
    if(feature IN_LIST FEATURES)
        list(APPEND options "-DCMAKE_REQUIRE_FIND_PACKAGE_${package}=ON")
    else()
        list(APPEND options "-DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON")
    endif()
endforeach()

vcpkg_cmake_configure(
    SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS
        -DSIVID_BUILD_TESTS=OFF
        -DSIVID_BUILD_EXAMPLES=OFF
        -DSIVID_BUILD_BENCHMARKS=OFF
        -DSIVID_BUILD_PYTHON=OFF
        -DSIVID_INSTALL=ON
        ${options}
    MAYBE_UNUSED_VARIABLES
        CMAKE_DISABLE_FIND_PACKAGE_MPI
        CMAKE_REQUIRE_FIND_PACKAGE_TBB
        CMAKE_DISABLE_FIND_PACKAGE_TBB
)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH share/cmake/sivid)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/share/doc")
if(NOT "library" IN_LIST FEATURES)
    file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/lib")
endif()

file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")

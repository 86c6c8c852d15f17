# SPDX-License-Identifier: MIT
# Packages by CPack: `cpack -G DEB` makes libsivid-dev (headers, for any machine) and sivid (programs), `cpack -G TGZ` the
# same as archives. `scripts/packages` builds and makes all of them.

set(SIVID_PACKAGER "sivid contributors <sivid@localhost>" CACHE STRING "Who answers for the packages: name <address>")

set(CPACK_PACKAGE_NAME sivid)
set(CPACK_PACKAGE_VENDOR "sivid contributors")
set(CPACK_PACKAGE_CONTACT "${SIVID_PACKAGER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")   # each package has its own, in the first line of its description
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGE_CHECKSUM SHA256)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_ARCHIVE_SIVID_HEADERS_FILE_NAME "sivid-${PROJECT_VERSION}-headers")
set(CPACK_ARCHIVE_SIVID_PROGRAMS_FILE_NAME
    "sivid-${PROJECT_VERSION}-programs-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}")

# What is compiled for the machine that builds it would die of SIGILL on another, so it is not packed.
set(CPACK_COMPONENTS_ALL sivid_headers)
set(sivid_all_flags "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_RELEASE}")
if(SIVID_NATIVE OR SIVID_SANITIZE OR sivid_all_flags MATCHES "=native")
    message(STATUS "sivid: packages of headers only; programs are compiled for this machine alone, or with sanitizers")
elseif(TARGET hovercraft AND TARGET sivid-import)
    list(APPEND CPACK_COMPONENTS_ALL sivid_programs)
endif()

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
# Copyright, change log and stripped programs as Debian wants them.
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/debian_files.cmake")
set(CPACK_SIVID_STRIP "${CMAKE_STRIP}")

set(CPACK_COMPONENT_SIVID_HEADERS_DESCRIPTION
"set-inversion validated identification (headers)
A header-only C++20 library that says which parameters of a dynamic model can
explain recorded data, with proof: sets are certified inside or outside by
validated integration, bisection and contraction.
.
Package files for CMake and pkg-config and the guides are here, too.")
set(CPACK_DEBIAN_SIVID_HEADERS_PACKAGE_NAME libsivid-dev)
set(CPACK_DEBIAN_SIVID_HEADERS_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_SIVID_HEADERS_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_SIVID_HEADERS_PACKAGE_DEPENDS "libboost-dev (>= 1.74), libeigen3-dev (>= 3.3)")
set(CPACK_DEBIAN_SIVID_HEADERS_PACKAGE_RECOMMENDS "nlohmann-json3-dev (>= 3.9)")
set(CPACK_DEBIAN_SIVID_HEADERS_PACKAGE_SUGGESTS "libcli11-dev, libtbb-dev, libmpfi-dev, libmatio-dev, libtomlplusplus-dev, cmake, pkg-config, sivid")

set(CPACK_COMPONENT_SIVID_PROGRAMS_DESCRIPTION
"set-inversion validated identification (programs)
sivid-hovercraft identifies, checks, predicts and diagnoses a hovercraft from
its records, with proof; sivid does so with a model of any robot that is a
text; both write reports. sivid-import turns tables, MATLAB
files and logs of serial streams into data sets.")
set(CPACK_DEBIAN_SIVID_PROGRAMS_PACKAGE_NAME sivid)
set(CPACK_DEBIAN_SIVID_PROGRAMS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_SIVID_PROGRAMS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_SIVID_PROGRAMS_PACKAGE_SUGGESTS "libsivid-dev")

include(CPack)

# SPDX-License-Identifier: MIT
# Packages by CPack: `cpack -G DEB` makes libsivid-dev (headers; what linking to libsivid needs), libsivid0 (libsivid.so.0),
# sivid (programs) and python3-sivid (where there is a target sivid_python, component python), of what is built; `cpack -G TGZ` the same as
# archives. `scripts/packages` builds and makes all of them.

set(SIVID_PACKAGER "sivid contributors <sivid@localhost>" CACHE STRING "Who answers for the packages: name <address>")

set(CPACK_PACKAGE_NAME sivid)
set(CPACK_PACKAGE_VENDOR "sivid contributors")
set(CPACK_PACKAGE_CONTACT "${SIVID_PACKAGER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")   # each package has its own, in the first line of its description
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_PACKAGE_CHECKSUM SHA256)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
# Copyright, change log and stripped files as Debian wants them.
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/debian_files.cmake")
set(CPACK_SIVID_STRIP "${CMAKE_STRIP}")

set(CPACK_COMPONENTS_ALL "")
set(CPACK_SIVID_PACKAGES "")
set(sivid_this_version "${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}")
# sivid_package(<package> NAME <name> ARCHIVE <file> SECTION <section> DESCRIPTION <text> COMPONENTS <component>...
#               [DEPENDS <packages>] [RECOMMENDS <packages>] [SUGGESTS <packages>] [ANY_MACHINE]): one of several components
# is a group of CPack's.
function(sivid_package package)
    cmake_parse_arguments(PARSE_ARGV 1 arg ANY_MACHINE "NAME;ARCHIVE;SECTION;DESCRIPTION;DEPENDS;RECOMMENDS;SUGGESTS" COMPONENTS)
    string(TOUPPER "${package}" upper)
    foreach(component IN LISTS arg_COMPONENTS)
        string(TOUPPER "${component}" component_upper)
        set(CPACK_COMPONENT_${component_upper}_GROUP ${package} PARENT_SCOPE)
    endforeach()
    set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${arg_COMPONENTS} PARENT_SCOPE)
    set(CPACK_SIVID_PACKAGES ${CPACK_SIVID_PACKAGES} ${package} PARENT_SCOPE)
    set(CPACK_DEBIAN_${upper}_PACKAGE_NAME "${arg_NAME}" PARENT_SCOPE)
    set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION "${arg_SECTION}" PARENT_SCOPE)
    set(CPACK_DEBIAN_${upper}_DESCRIPTION "${arg_DESCRIPTION}" PARENT_SCOPE)
    foreach(field IN ITEMS DEPENDS RECOMMENDS SUGGESTS)
        set(CPACK_DEBIAN_${upper}_PACKAGE_${field} "${arg_${field}}" PARENT_SCOPE)
    endforeach()
    set(file "sivid-${PROJECT_VERSION}-${arg_ARCHIVE}")
    if(arg_ANY_MACHINE)
        set(CPACK_DEBIAN_${upper}_PACKAGE_ARCHITECTURE all PARENT_SCOPE)
    else()
        set(CPACK_DEBIAN_${upper}_PACKAGE_SHLIBDEPS ON PARENT_SCOPE)
        string(APPEND file "-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}")
    endif()
    set(CPACK_ARCHIVE_${upper}_FILE_NAME "${file}" PARENT_SCOPE)
endfunction()

set(of_headers COMPONENTS sivid_headers)
set(needed "libboost-dev (>= 1.74), libeigen3-dev (>= 3.3)")
if(SIVID_LIBRARY)
    list(APPEND of_headers sivid_linking)
    string(APPEND needed ", libsivid${PROJECT_VERSION_MAJOR} (= ${sivid_this_version})")
else()
    list(APPEND of_headers ANY_MACHINE)
endif()
sivid_package(sivid_development NAME libsivid-dev ARCHIVE headers SECTION libdevel ${of_headers} DEPENDS "${needed}"
    RECOMMENDS "nlohmann-json3-dev (>= 3.9), libcli11-dev, libtomlplusplus-dev"
    SUGGESTS "libtbb-dev, libmpfi-dev, libmatio-dev, libexpat1-dev, liburdfdom-dev, cmake, pkg-config, sivid"
    DESCRIPTION "set-inversion validated identification (headers)
A C++20 library that says which parameters of a dynamic model can
explain recorded data, with proof: sets are certified inside or outside by
validated integration, bisection and contraction.
.
Headers, which need no library, and what linking to libsivid needs, so that
programs compile in seconds; package files for CMake and pkg-config; guides.")
if(SIVID_LIBRARY)
    set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
    set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}")
    sivid_package(sivid_runtime NAME libsivid${PROJECT_VERSION_MAJOR} ARCHIVE library SECTION libs COMPONENTS sivid_library
        DESCRIPTION "set-inversion validated identification (library)
What most of the compile time of sivid goes into, compiled once. The loader
takes the code for the instructions that the processor has: all give the same
results.")
endif()

# What is compiled for the machine that builds it would die of SIGILL on another, so it is not packed.
set(sivid_all_flags "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_RELEASE}")
if(SIVID_NATIVE OR SIVID_SANITIZE OR sivid_all_flags MATCHES "=native")
    message(STATUS "sivid: packages of headers only; programs are compiled for this machine alone, or with sanitizers")
elseif(TARGET hovercraft AND TARGET sivid)
    set(needed "")
    if(SIVID_LIBRARY)
        set(needed "libsivid${PROJECT_VERSION_MAJOR} (= ${sivid_this_version})")
    endif()
    sivid_package(sivid_programs NAME sivid ARCHIVE programs SECTION science COMPONENTS sivid_programs DEPENDS "${needed}"
        SUGGESTS libsivid-dev
        DESCRIPTION "set-inversion validated identification (programs)
sivid-hovercraft identifies, checks, predicts and diagnoses a hovercraft from
its records, with proof; sivid does so with a model of any robot that is a
text; both write reports and turn tables, MATLAB
files and logs of serial streams into data sets.")
endif()
if(TARGET sivid_python)
    set(needed "python3, python3-numpy")
    if(SIVID_LIBRARY)
        string(APPEND needed ", libsivid${PROJECT_VERSION_MAJOR} (= ${sivid_this_version})")
    endif()
    sivid_package(sivid_python NAME python3-sivid ARCHIVE python SECTION python COMPONENTS python DEPENDS "${needed}"
        DESCRIPTION "set-inversion validated identification (Python)
Models, data sets and identifications of sivid for Python 3.")
endif()

include(CPack)

# SPDX-License-Identifier: MIT
# Install rules, in components: sivid_headers (headers, package files for find_package(sivid) and pkg-config, guides) and
# sivid_programs (sivid, sivid-hovercraft and its data) here, sivid_library (libsivid.so.0) and
# sivid_linking (what a program that links to it needs beside headers) in library.cmake. `cmake --install <build> --component ...` takes one.

include(GNUInstallDirs)
include("${CMAKE_CURRENT_LIST_DIR}/version_file.cmake")
include(CMakePackageConfigHelpers)

set(sivid_package_dir "${CMAKE_INSTALL_DATADIR}/cmake/sivid")   # nothing in it depends on the machine
set(sivid_pkgconfig_dir "${CMAKE_INSTALL_DATADIR}/pkgconfig")
set(sivid_library_package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/sivid")   # but libsivid
file(RELATIVE_PATH sivid_run_path "/prefix/${CMAKE_INSTALL_BINDIR}" "/prefix/${CMAKE_INSTALL_LIBDIR}")
set(sivid_run_path "$ORIGIN/${sivid_run_path}")

# Folders of an installation, from the folder of a file for pkg-config: it may be moved as a whole.
function(sivid_pkgconfig_folders of)
    set(prefix "${CMAKE_INSTALL_PREFIX}")
    if(NOT IS_ABSOLUTE "${of}")
        file(RELATIVE_PATH back "/prefix/${of}" "/prefix")
        set(prefix "\${pcfiledir}/${back}")
    endif()
    foreach(folder IN ITEMS include lib)
        string(TOUPPER "${folder}" upper)
        set(${folder}dir "${CMAKE_INSTALL_${upper}DIR}")
        if(NOT IS_ABSOLUTE "${${folder}dir}")
            set(${folder}dir "\${prefix}/${${folder}dir}")
        endif()
        set(${folder}dir "${${folder}dir}" PARENT_SCOPE)
    endforeach()
    set(prefix "${prefix}" PARENT_SCOPE)
endfunction()

# sivid_install_pkgconfig(<component> <description> <requires>): sivid.pc of the core, sivid-<component>.pc of the others.
function(sivid_install_pkgconfig component description requires)
    set(name "sivid-${component}")
    set(cflags "")
    if(component STREQUAL "sivid")
        set(name sivid)
        set(cflags " -I\${includedir}")
    elseif(component STREQUAL "parallel")
        set(cflags " -DSIVID_HAS_TBB=1")
    elseif(component STREQUAL "text")
        set(cflags " -DSIVID_HAS_TOML=1")
    elseif(component STREQUAL "matlab")
        set(cflags " -DSIVID_HAS_MATIO=1")
    elseif(component STREQUAL "xml")
        set(cflags " -DSIVID_HAS_EXPAT=1")
    elseif(component STREQUAL "urdf")
        set(cflags " -DSIVID_HAS_URDF=1")
    elseif(component STREQUAL "cluster")
        set(cflags " -DSIVID_HAS_MPI=1")
    endif()
    sivid_pkgconfig_folders("${sivid_pkgconfig_dir}")
    file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/${name}.pc" @ONLY CONTENT
"prefix=@prefix@
includedir=@includedir@

Name: @name@
Description: @description@
Version: @PROJECT_VERSION@
Requires: @requires@
Cflags:@cflags@
")
    install(FILES "${PROJECT_BINARY_DIR}/${name}.pc" DESTINATION "${sivid_pkgconfig_dir}" COMPONENT sivid_headers)
endfunction()

set(of_this "sivid = ${PROJECT_VERSION}")
sivid_install_pkgconfig(sivid "${PROJECT_DESCRIPTION} (C++20; needs the headers of Boost, too)" "eigen3 >= 3.3")
foreach(component IN LISTS sivid_components)
    if(component STREQUAL "io")
        sivid_install_pkgconfig(io "Data sets, results and checkpoints of sivid" "${of_this}, nlohmann_json >= 3.9")
    elseif(component STREQUAL "verifier")
        sivid_install_pkgconfig(verifier "Checks of stored results of sivid" "sivid-io = ${PROJECT_VERSION}")
    elseif(component STREQUAL "importing")
        sivid_install_pkgconfig(importing "Tables and logs as data sets of sivid" "sivid-io = ${PROJECT_VERSION}")
    elseif(component STREQUAL "matlab")
        sivid_install_pkgconfig(matlab "Files of MATLAB as data sets of sivid"
                                "sivid-importing = ${PROJECT_VERSION}, matio, zlib")
    elseif(component STREQUAL "xml")
        sivid_install_pkgconfig(xml "MJCF and URDF files for sivid" "sivid-io = ${PROJECT_VERSION}, expat")
    elseif(component STREQUAL "urdf")
        sivid_install_pkgconfig(urdf "Descriptions of robots as models of sivid"
                                "sivid-importing = ${PROJECT_VERSION}, urdfdom, tinyxml")
    elseif(component STREQUAL "text")
        sivid_install_pkgconfig(text "Models of sivid as text (needs the headers of toml++, too)"
                                "sivid-io = ${PROJECT_VERSION}")
    elseif(component STREQUAL "report")
        sivid_install_pkgconfig(report "Reports of sivid" "sivid-io = ${PROJECT_VERSION}")
    elseif(component STREQUAL "parallel")
        sivid_install_pkgconfig(parallel "Threads for sivid, with oneTBB" "${of_this}, tbb")
    elseif(component STREQUAL "cluster")
        sivid_install_pkgconfig(cluster "Ranks of MPI for sivid (needs Boost.MPI, too)" "sivid-io = ${PROJECT_VERSION}")
    endif()   # sivid::app is compiled: for CMake alone

    set(file_set "")
    if(CMAKE_VERSION VERSION_GREATER_EQUAL 3.23)
        set(file_set FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT sivid_headers)
    else()
        get_target_property(headers sivid_${component} SIVID_HEADERS)
        foreach(header IN LISTS headers)
            file(RELATIVE_PATH relative "${sivid_include_dir}" "${header}")
            get_filename_component(folder "${relative}" DIRECTORY)
            install(FILES "${header}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/${folder}" COMPONENT sivid_headers)
        endforeach()
    endif()
    install(TARGETS sivid_${component} EXPORT sivid_${component}_targets ${file_set}
            INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
    install(EXPORT sivid_${component}_targets FILE sivid_${component}_targets.cmake
            NAMESPACE sivid:: DESTINATION "${sivid_package_dir}" COMPONENT sivid_headers)
endforeach()

configure_package_config_file(
    "${CMAKE_CURRENT_LIST_DIR}/sividConfig.cmake.in" "${PROJECT_BINARY_DIR}/sividConfig.cmake"
    INSTALL_DESTINATION "${sivid_package_dir}" PATH_VARS sivid_library_package_dir)
sivid_write_version_file("${PROJECT_BINARY_DIR}/sividConfigVersion.cmake" "${PROJECT_VERSION}")
install(FILES "${PROJECT_BINARY_DIR}/sividConfig.cmake" "${PROJECT_BINARY_DIR}/sividConfigVersion.cmake"
        DESTINATION "${sivid_package_dir}" COMPONENT sivid_headers)
install(FILES "${CMAKE_CURRENT_LIST_DIR}/find_mpi.cmake" "${CMAKE_CURRENT_LIST_DIR}/find_matio.cmake"
        "${CMAKE_CURRENT_LIST_DIR}/find_expat.cmake"
        "${CMAKE_CURRENT_LIST_DIR}/find_urdf.cmake"
        "${CMAKE_CURRENT_LIST_DIR}/app.cmake"
        "${CMAKE_CURRENT_LIST_DIR}/find_toml.cmake"
        DESTINATION "${sivid_package_dir}" COMPONENT sivid_headers)
install(FILES "${CMAKE_CURRENT_LIST_DIR}/compiled.cmake" DESTINATION "${sivid_package_dir}" RENAME sivid_compiled.cmake
        COMPONENT sivid_headers)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/README.md" "${PROJECT_SOURCE_DIR}/CHANGELOG.md"
        DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/sivid" COMPONENT sivid_headers)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/docs" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/sivid" COMPONENT sivid_headers
        FILES_MATCHING PATTERN "*.md" PATTERN "*.svg" PATTERN "*.png")

# sivid_install_documents(<component>): those that each Debian package has.
function(sivid_install_documents component)
    install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" "${PROJECT_SOURCE_DIR}/CHANGELOG.md"
            DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/sivid" COMPONENT ${component})
endfunction()
sivid_install_documents(sivid_programs)

# sivid_install_program(<target> [<data folder>]): under a name that says whose it is (Debian has a `hovercraft` of
# another kind). A tree in which nothing is built installs its headers all the same.
function(sivid_install_program target)
    string(REPLACE sivid- "" name "${target}")
    set(program "sivid-${name}")
    if(target STREQUAL "sivid")
        set(program sivid)
    endif()
    if(program STREQUAL target)   # CMake renames no target
        install(TARGETS ${target} DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT sivid_programs OPTIONAL)
    else()
        install(PROGRAMS "$<TARGET_FILE:${target}>" DESTINATION "${CMAKE_INSTALL_BINDIR}"
                RENAME "${program}${CMAKE_EXECUTABLE_SUFFIX}" COMPONENT sivid_programs OPTIONAL)
    endif()
    foreach(folder IN LISTS ARGN)
        install(DIRECTORY "${folder}/" DESTINATION "${CMAKE_INSTALL_DATADIR}/sivid/${name}" COMPONENT sivid_programs)
    endforeach()
    install(FILES "${CMAKE_CURRENT_SOURCE_DIR}/${program}.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1"
            COMPONENT sivid_programs)
endfunction()

# SPDX-License-Identifier: MIT
# Install rules: headers, one export set for each component, package files for find_package(sivid).

include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(sivid_package_dir "${CMAKE_INSTALL_DATADIR}/cmake/sivid")   # nothing in it depends on the machine

foreach(component IN LISTS sivid_components)
    set(file_set "")
    if(CMAKE_VERSION VERSION_GREATER_EQUAL 3.23)
        set(file_set FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
    else()
        get_target_property(headers sivid_${component} SIVID_HEADERS)
        foreach(header IN LISTS headers)
            file(RELATIVE_PATH relative "${sivid_include_dir}" "${header}")
            get_filename_component(folder "${relative}" DIRECTORY)
            install(FILES "${header}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/${folder}")
        endforeach()
    endif()
    install(TARGETS sivid_${component} EXPORT sivid_${component}_targets ${file_set}
            INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
    install(EXPORT sivid_${component}_targets FILE sivid_${component}_targets.cmake
            NAMESPACE sivid:: DESTINATION "${sivid_package_dir}")
endforeach()

configure_package_config_file(
    "${CMAKE_CURRENT_LIST_DIR}/sividConfig.cmake.in" "${PROJECT_BINARY_DIR}/sividConfig.cmake"
    INSTALL_DESTINATION "${sivid_package_dir}")
write_basic_package_version_file(
    "${PROJECT_BINARY_DIR}/sividConfigVersion.cmake"
    COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES "${PROJECT_BINARY_DIR}/sividConfig.cmake" "${PROJECT_BINARY_DIR}/sividConfigVersion.cmake"
        DESTINATION "${sivid_package_dir}")
install(FILES "${CMAKE_CURRENT_LIST_DIR}/compiled.cmake" DESTINATION "${sivid_package_dir}" RENAME sivid_compiled.cmake)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/sivid")

# SPDX-License-Identifier: MIT
# What sivid::urdf links to, in sivid_urdf_libraries; empty where it is not installed.

set(sivid_urdf_libraries "")
find_path(SIVID_URDF_INCLUDE urdf_parser/urdf_parser.h)
find_path(SIVID_URDF_MODEL_INCLUDE urdf_model/model.h)
find_path(SIVID_TINYXML_INCLUDE tinyxml.h)
find_library(SIVID_URDF urdfdom_model)
find_library(SIVID_TINYXML tinyxml)
find_library(SIVID_CONSOLE_BRIDGE console_bridge)
mark_as_advanced(SIVID_URDF_INCLUDE SIVID_URDF_MODEL_INCLUDE SIVID_TINYXML_INCLUDE SIVID_URDF SIVID_TINYXML SIVID_CONSOLE_BRIDGE)
if(SIVID_URDF_INCLUDE AND SIVID_URDF_MODEL_INCLUDE AND SIVID_TINYXML_INCLUDE AND SIVID_URDF AND SIVID_TINYXML
   AND SIVID_CONSOLE_BRIDGE)
    if(NOT TARGET urdfdom::model)   # by its name in the package files, which then hold for any machine
        add_library(urdfdom::model UNKNOWN IMPORTED)
        set_target_properties(urdfdom::model PROPERTIES IMPORTED_LOCATION "${SIVID_URDF}"
            INTERFACE_INCLUDE_DIRECTORIES "${SIVID_URDF_INCLUDE};${SIVID_URDF_MODEL_INCLUDE};${SIVID_TINYXML_INCLUDE}"
            INTERFACE_LINK_LIBRARIES "${SIVID_TINYXML};${SIVID_CONSOLE_BRIDGE}")
    endif()
    set(sivid_urdf_libraries urdfdom::model)
endif()

# SPDX-License-Identifier: MIT
# The header-only targets: sivid::sivid (core), and beside it sivid::io, sivid::verifier, sivid::importing, sivid::report,
# sivid::matlab, sivid::urdf, sivid::xml, sivid::text, sivid::parallel, sivid::cluster, and sivid::app_headers, which
# cmake/app.cmake makes sivid::app of.

if(POLICY CMP0167)
    cmake_policy(SET CMP0167 NEW)   # BoostConfig.cmake of Boost itself
endif()
find_package(Boost 1.74 REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)

set(sivid_core_folders number space measurement model approximate enclosure paving decision diagnosis)
set(sivid_include_dir "${PROJECT_SOURCE_DIR}/include")
set(sivid_components "")

# sivid_add_library(<name> FOLDERS <floor>... [FILES <header>...] [LINK <target>...]):
# INTERFACE target sivid_<name> (alias and export name sivid::<name>) with the headers of these floors.
function(sivid_add_library name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "FOLDERS;FILES;LINK")
    set(headers "")
    foreach(folder IN LISTS arg_FOLDERS)
        file(GLOB_RECURSE found CONFIGURE_DEPENDS "${sivid_include_dir}/sivid/${folder}/*.hpp"
            "${sivid_include_dir}/sivid/${folder}/*.ipp")
        list(APPEND headers ${found})
    endforeach()
    foreach(file IN LISTS arg_FILES)
        list(APPEND headers "${sivid_include_dir}/sivid/${file}")
    endforeach()

    set(target sivid_${name})
    add_library(${target} INTERFACE)
    add_library(sivid::${name} ALIAS ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} SIVID_HEADERS "${headers}")
    target_compile_features(${target} INTERFACE cxx_std_20)
    target_include_directories(${target} INTERFACE "$<BUILD_INTERFACE:${sivid_include_dir}>")
    target_link_libraries(${target} INTERFACE ${arg_LINK})
    if(CMAKE_VERSION VERSION_GREATER_EQUAL 3.23 AND headers)
        target_sources(${target} INTERFACE
            FILE_SET HEADERS BASE_DIRS "${sivid_include_dir}" FILES ${headers})
    endif()
    set(sivid_components ${sivid_components} ${name} PARENT_SCOPE)
endfunction()

sivid_add_library(sivid FOLDERS ${sivid_core_folders} impl FILES sivid.hpp compiled.hpp executor.hpp version.hpp
                  work_clock.hpp work_limit.hpp
                  LINK Boost::headers Eigen3::Eigen)

# sivid_add_optional(<name> <option> <found> <packages> ...): sivid_add_library(<name> ...) with SIVID_HAS_<option>, where
# SIVID_WITH_<option> is wanted and what it needs was found.
macro(sivid_add_optional name option found packages)
    if(SIVID_WITH_${option} AND NOT "${found}" MATCHES "NOTFOUND$|^$")
        sivid_add_library(${name} ${ARGN})
        target_compile_definitions(sivid_${name} INTERFACE SIVID_HAS_${option}=1)
    else()
        message(STATUS "sivid: sivid::${name} left out, not wanted or not found (Debian: ${packages})")
    endif()
endmacro()

find_package(nlohmann_json 3.9 QUIET)
if(nlohmann_json_FOUND)
    foreach(part IN ITEMS toml matio expat urdf)
        include("${CMAKE_CURRENT_LIST_DIR}/find_${part}.cmake")
    endforeach()
    sivid_add_library(io FOLDERS io LINK sivid_sivid nlohmann_json::nlohmann_json)
    foreach(component IN ITEMS verifier importing report)   # each on io, none on another
        sivid_add_library(${component} FOLDERS ${component} LINK sivid_io)
    endforeach()
    # Headers of matlab and urdf stand in importing, those of xml in io.
    sivid_add_optional(text TOML "${sivid_toml_include}" libtomlplusplus-dev FOLDERS text LINK sivid_io tomlplusplus::tomlplusplus)
    sivid_add_optional(matlab MATIO "${sivid_matio_libraries}" "libmatio-dev zlib1g-dev" LINK sivid_importing ${sivid_matio_libraries})
    sivid_add_optional(xml EXPAT "${sivid_expat_libraries}" libexpat1-dev LINK sivid_io ${sivid_expat_libraries})
    sivid_add_optional(urdf URDF "${sivid_urdf_libraries}" liburdfdom-dev LINK sivid_importing ${sivid_urdf_libraries})
else()
    message(STATUS "sivid: nlohmann_json not found: sivid::io and what stands on it (verifier, importing, report, text) left out")
endif()

if(EXISTS "${sivid_include_dir}/sivid/parallel")
    find_package(TBB QUIET)
    if(TBB_FOUND)
        sivid_add_library(parallel FOLDERS parallel LINK sivid_sivid TBB::tbb)
        target_compile_definitions(sivid_parallel INTERFACE SIVID_HAS_TBB=1)
    else()
        message(STATUS "sivid: oneTBB not found, sivid::parallel left out")
    endif()
endif()

if(EXISTS "${sivid_include_dir}/sivid/cluster" AND TARGET sivid::io)
    include("${CMAKE_CURRENT_LIST_DIR}/find_mpi.cmake")
    if(sivid_mpi_libraries)
        sivid_add_library(cluster FOLDERS cluster LINK sivid_io ${sivid_mpi_libraries})
        target_compile_definitions(sivid_cluster INTERFACE SIVID_HAS_MPI=1)
    else()
        message(STATUS "sivid: MPI or Boost.MPI not found, sivid::cluster left out")
    endif()
endif()

if(TARGET sivid::report)
    find_package(CLI11 QUIET)
    if(CLI11_FOUND)
        # Of cluster those headers that need no MPI: what a program sees of ranks, and the threads of a fleet.
        sivid_add_library(app_headers FOLDERS app cluster LINK sivid_report sivid_verifier sivid_importing CLI11::CLI11)
    else()
        message(STATUS "sivid: CLI11 not found, sivid::app left out")
    endif()
endif()

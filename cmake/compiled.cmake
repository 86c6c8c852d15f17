# SPDX-License-Identifier: MIT
# sivid::compiled: what most of the compile time goes into, compiled once instead of in every source that uses it: the
# integrators behind identification and the functions that are defined in impl/*.ipp. Programs that link to it find them declared
# only; they have to be compiled with the same flags. Without it everything comes from the headers.
#
# Included by sivid's own tree and, where it is installed, by find_package(sivid COMPONENTS compiled): either way it is
# built in the tree of whoever links to it, with the flags of that tree.

set(sivid_compiled_sources "")
function(sivid_compiled_source name text)
    set(source "${CMAKE_CURRENT_BINARY_DIR}/sivid_compiled/${name}.cpp")
    file(CONFIGURE OUTPUT "${source}" CONTENT "// SPDX-License-Identifier: MIT\n${text}" @ONLY)
    if(name IN_LIST SIVID_UNOPTIMISED_PARTS)
        set_source_files_properties("${source}" PROPERTIES COMPILE_OPTIONS -O0)
    elseif(name IN_LIST SIVID_OPTIMISED_PARTS)
        set_source_files_properties("${source}" PROPERTIES COMPILE_OPTIONS -O2)
    endif()
    set(sivid_compiled_sources ${sivid_compiled_sources} "${source}" PARENT_SCOPE)
endfunction()

# Each part of include/sivid/impl is one source: they are compiled side by side, and none takes more than 2 GB.
set(parts library number space measurement model approximate enclosure tube flow flow_lanes paving paving_lanes paving_further
    decision diagnosis)
if(TARGET sivid::io)
    list(APPEND parts io)
endif()
foreach(component IN ITEMS verifier report text)
    if(TARGET sivid::${component})
        list(APPEND parts ${component})
    endif()
endforeach()
macro(sivid_move_parts where)   # those of the further arguments that are among the parts
    foreach(part IN ITEMS ${ARGN})
        if(part IN_LIST parts)
            list(REMOVE_ITEM parts ${part})
            list(${where} parts ${part})
        endif()
    endforeach()
endmacro()
sivid_move_parts(PREPEND ${SIVID_OPTIMISED_PARTS})
sivid_move_parts(APPEND ${SIVID_UNOPTIMISED_PARTS})
foreach(part IN LISTS parts)
    sivid_compiled_source(${part} "#include <sivid/impl/${part}.ipp>\n")
endforeach()

add_library(sivid_compiled STATIC EXCLUDE_FROM_ALL ${sivid_compiled_sources})
add_library(sivid::compiled ALIAS sivid_compiled)
target_compile_definitions(sivid_compiled PUBLIC SIVID_COMPILED)
set_target_properties(sivid_compiled PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden)   # in shared libraries
foreach(component IN ITEMS sivid io verifier report text)
    if(TARGET sivid::${component})
        target_link_libraries(sivid_compiled PRIVATE sivid::${component})
    endif()
endforeach()

# sivid::compiled_mpfi: the check of stored results in the interval types of MPFI, where that is installed.
find_library(SIVID_GMP gmp)
find_library(SIVID_MPFR mpfr)
find_library(SIVID_MPFI mpfi)
find_path(SIVID_MPFI_INCLUDE mpfi.h)
mark_as_advanced(SIVID_GMP SIVID_MPFR SIVID_MPFI SIVID_MPFI_INCLUDE)
if(TARGET sivid::verifier AND SIVID_GMP AND SIVID_MPFR AND SIVID_MPFI AND SIVID_MPFI_INCLUDE)
    set(sivid_compiled_sources "")
    foreach(function IN ITEMS check_by_proven_functions check_in_multiprecision)
        sivid_compiled_source(${function} "#include <sivid/verifier/impl/${function}.ipp>\n")
    endforeach()
    add_library(sivid_compiled_mpfi STATIC EXCLUDE_FROM_ALL ${sivid_compiled_sources})
    add_library(sivid::compiled_mpfi ALIAS sivid_compiled_mpfi)
    target_compile_definitions(sivid_compiled_mpfi PUBLIC SIVID_COMPILED_MPFI)
    set_target_properties(sivid_compiled_mpfi PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden)
    target_include_directories(sivid_compiled_mpfi SYSTEM PUBLIC "${SIVID_MPFI_INCLUDE}")
    target_link_libraries(sivid_compiled_mpfi PUBLIC sivid_compiled "${SIVID_MPFI}" "${SIVID_MPFR}" "${SIVID_GMP}"
                          PRIVATE sivid::verifier)
endif()

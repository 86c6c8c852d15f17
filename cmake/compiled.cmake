# SPDX-License-Identifier: MIT
# sivid::compiled: what most of the compile time goes into, compiled once instead of in every source that uses it: the
# integrators behind identification and the functions that are defined in impl/*.ipp. Programs that link to it find them declared
# only; they have to be compiled with the same flags. Without it everything comes from the headers.
#
# Included by sivid's own tree and, where it is installed, by find_package(sivid COMPONENTS compiled): either way it is
# built in the tree of whoever links to it, with the flags of that tree.

# sivid_compiled_parts(<name> <header>...): a source for each header, into sivid_compiled_sources, those first that are
# optimised. With SIVID_JOIN_PARTS those that are optimised alike stand in one source, named by the first argument.
function(sivid_compiled_parts name)
    set(optimised "")
    set(plain "")
    set(unoptimised "")
    foreach(header IN LISTS ARGN)
        get_filename_component(part "${header}" NAME_WE)
        set(level plain)
        if(part IN_LIST SIVID_UNOPTIMISED_PARTS)
            set(level unoptimised)
        elseif(part IN_LIST SIVID_OPTIMISED_PARTS)
            set(level optimised)
        endif()
        set(source "${part}")
        if(SIVID_JOIN_PARTS)
            set(source "${name}_${level}")
        endif()
        string(APPEND text_${source} "#include <${header}>\n")
        list(APPEND ${level} "${source}")
    endforeach()
    set(sivid_compiled_sources "")
    foreach(level IN ITEMS optimised plain unoptimised)
        list(REMOVE_DUPLICATES ${level})
        foreach(source IN LISTS ${level})
            set(file "${CMAKE_CURRENT_BINARY_DIR}/sivid_compiled/${source}.cpp")
            file(CONFIGURE OUTPUT "${file}" CONTENT "// SPDX-License-Identifier: MIT\n${text_${source}}" @ONLY)
            if(level STREQUAL "optimised")
                set_source_files_properties("${file}" PROPERTIES COMPILE_OPTIONS -O2)
            elseif(level STREQUAL "unoptimised")
                set_source_files_properties("${file}" PROPERTIES COMPILE_OPTIONS -O0)
            endif()
            list(APPEND sivid_compiled_sources "${file}")
        endforeach()
    endforeach()
    set(sivid_compiled_sources ${sivid_compiled_sources} PARENT_SCOPE)
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
list(TRANSFORM parts PREPEND sivid/impl/)
list(TRANSFORM parts APPEND .ipp)
sivid_compiled_parts(compiled ${parts})
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
    sivid_compiled_parts(mpfi sivid/verifier/impl/check_by_proven_functions.ipp sivid/verifier/impl/check_in_multiprecision.ipp)
    add_library(sivid_compiled_mpfi STATIC EXCLUDE_FROM_ALL ${sivid_compiled_sources})
    add_library(sivid::compiled_mpfi ALIAS sivid_compiled_mpfi)
    target_compile_definitions(sivid_compiled_mpfi PUBLIC SIVID_COMPILED_MPFI)
    set_target_properties(sivid_compiled_mpfi PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden)
    target_include_directories(sivid_compiled_mpfi SYSTEM PUBLIC "${SIVID_MPFI_INCLUDE}")
    target_link_libraries(sivid_compiled_mpfi PUBLIC sivid_compiled "${SIVID_MPFI}" "${SIVID_MPFR}" "${SIVID_GMP}"
                          PRIVATE sivid::verifier)
endif()

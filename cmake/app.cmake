# SPDX-License-Identifier: MIT
# sivid::app: the program of a robot around its model (include/sivid/app), compiled once, as sivid::compiled, to which it
# belongs. It works on all threads where sivid::parallel is, checks in 40 digits where MPFI is, imports files of MATLAB
# where sivid::matlab is, reads descriptions of robots where sivid::urdf is, changes MJCF and URDF where sivid::xml is, and
# shares its work by MPI where sivid::cluster is (asked for, or SIVID_PROGRAMS_WITH_MPI).
#
# Included behind compiled.cmake by sivid's own tree and by find_package(sivid COMPONENTS app).

if(NOT TARGET sivid::app_headers OR TARGET sivid::app)
    return()
endif()
sivid_compiled_parts(app sivid/impl/app_identification.ipp sivid/impl/app_decision.ipp sivid/impl/app.ipp)
add_library(sivid_app STATIC EXCLUDE_FROM_ALL ${sivid_compiled_sources})
add_library(sivid::app ALIAS sivid_app)
set_target_properties(sivid_app PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden)
find_package(Threads REQUIRED) # a fleet has one for each of its processes
target_link_libraries(sivid_app PUBLIC sivid::app_headers sivid_compiled PRIVATE Threads::Threads)
foreach(component IN ITEMS parallel matlab xml urdf)
    if(TARGET sivid::${component})
        target_link_libraries(sivid_app PRIVATE sivid::${component})
    endif()
endforeach()
if(TARGET sivid::cluster AND (SIVID_PROGRAMS_WITH_MPI OR NOT DEFINED SIVID_PROGRAMS_WITH_MPI))
    sivid_compiled_parts(mpi sivid/impl/cluster.ipp)
    add_library(sivid_app_mpi STATIC EXCLUDE_FROM_ALL ${sivid_compiled_sources})
    set_target_properties(sivid_app_mpi PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden)
    target_link_libraries(sivid_app_mpi PUBLIC sivid::app_headers sivid::cluster sivid_compiled)
    target_link_libraries(sivid_app INTERFACE sivid_app_mpi)   # the program asks for it, by default
endif()
if(TARGET sivid::compiled_mpfi)
    target_compile_definitions(sivid_app PRIVATE SIVID_HAS_MPFI=1)
    target_link_libraries(sivid_app PRIVATE sivid_compiled_mpfi)
endif()

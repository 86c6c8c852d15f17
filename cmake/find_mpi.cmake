# SPDX-License-Identifier: MIT
# What sivid::cluster links to, in sivid_mpi_libraries; empty where it is not installed.

set(sivid_mpi_libraries "")
get_property(sivid_languages GLOBAL PROPERTY ENABLED_LANGUAGES)
if("CXX" IN_LIST sivid_languages)
    find_package(Boost 1.74 QUIET OPTIONAL_COMPONENTS mpi serialization)
    if(TARGET Boost::mpi AND TARGET Boost::serialization)
        set(MPI_CXX_SKIP_MPICXX ON)   # the old bindings for C++, which nobody here uses
        find_package(MPI QUIET COMPONENTS CXX)
        find_package(Threads QUIET)
        if(MPI_CXX_FOUND AND Threads_FOUND)
            set(sivid_mpi_libraries Boost::mpi Boost::serialization MPI::MPI_CXX Threads::Threads)
        endif()
    endif()
endif()

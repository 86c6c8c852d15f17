# SPDX-License-Identifier: MIT
# sivid::compiled: what most of the compile time goes into, compiled once instead of in every source that uses it: the
# integrators behind identification and the functions marked SIVID_ENTRY. Programs that link to it find them declared
# only; they have to be compiled with the same flags. Without it everything comes from the headers.
#
# Included by sivid's own tree and, where it is installed, by find_package(sivid COMPONENTS compiled): either way it is
# built in the tree of whoever links to it, with the flags of that tree. `sivid_include_dir` says where the headers are.

set(sivid_compiled_sources "")
function(sivid_compiled_source name text)
    set(source "${CMAKE_CURRENT_BINARY_DIR}/sivid_compiled/${name}.cpp")
    file(CONFIGURE OUTPUT "${source}" CONTENT "// SPDX-License-Identifier: MIT\n${text}" @ONLY)
    set(sivid_compiled_sources ${sivid_compiled_sources} "${source}" PARENT_SCOPE)
endfunction()

file(STRINGS "${sivid_include_dir}/sivid/paving/taylor_kernels.hpp" kernels REGEX "define SIVID_TAYLOR_KERNELS")
string(REGEX MATCHALL "[0-9]+, [0-9]+" kernels "${kernels}")
foreach(kernel IN LISTS kernels)
    string(REPLACE ", " "_" name "${kernel}")
    sivid_compiled_source(kernel_${name} "\
#include <sivid/paving/continued_run.hpp>
namespace sivid::paving_detail {
template std::unique_ptr<experiment_run> make_taylor_run<${kernel}>(
    flow const&, experiment const&, record const&, run_options const&);
template std::unique_ptr<continued_run> make_taylor_continuation<${kernel}>(
    flow const&, double, enclosure_options const&);
}
")
endforeach()

sivid_compiled_source(enclosure "\
#include <sivid/enclosure/tube.hpp>
namespace sivid {
template tube<interval> integrate(
    std::shared_ptr<flow const>, box const&, box const&, double, double, enclosure_options const&);
}
")

# Headers with functions that are compiled once; those of one floor share most of their code.
set(entries_number decimal_text)
set(entries_paving identify inflation holdout_inflation outlier_budget)
set(entries_diagnosis diagnose diagnosis_run)
set(entries_io dataset explaining_motion)
set(entries_report identification_report identification_page diagnosis_report diagnosis_page)
foreach(floor IN ITEMS number paving diagnosis io report)
    if(floor MATCHES "^(io|report)$" AND NOT TARGET sivid::${floor})
        continue()
    endif()
    set(macros "")
    set(includes "")
    foreach(header IN LISTS entries_${floor})
        file(STRINGS "${sivid_include_dir}/sivid/${floor}/${header}.hpp" condition REGEX "SIVID_COMPILE_[A-Z_]+")
        string(REGEX MATCH "SIVID_COMPILE_[A-Z_]+" macro "${condition}")
        string(APPEND macros "#define ${macro}\n")
        string(APPEND includes "#include <sivid/${floor}/${header}.hpp>\n")
    endforeach()
    sivid_compiled_source(${floor} "${macros}${includes}")
endforeach()

add_library(sivid_compiled STATIC EXCLUDE_FROM_ALL ${sivid_compiled_sources})
add_library(sivid::compiled ALIAS sivid_compiled)
target_compile_definitions(sivid_compiled PUBLIC SIVID_COMPILED)
foreach(component IN ITEMS sivid io report)
    if(TARGET sivid::${component})
        target_link_libraries(sivid_compiled PRIVATE sivid::${component})
    endif()
endforeach()

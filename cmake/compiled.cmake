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
#include <sivid/paving/detail/taylor_continuation.hpp>
#include <sivid/paving/detail/taylor_run.hpp>
namespace sivid::paving_detail {
template std::unique_ptr<experiment_run> make_taylor_run<${kernel}>(
    flow const&, experiment const&, record const&, run_options const&);
template std::unique_ptr<continued_run> make_taylor_continuation<${kernel}>(
    flow const&, double, enclosure_options const&);
}
")
endforeach()

file(STRINGS "${sivid_include_dir}/sivid/paving/detail/scalar_taylor_run.hpp" kernels
     REGEX "define SIVID_SCALAR_KERNELS")
string(REGEX MATCHALL "[0-9]+, [0-9]+" kernels "${kernels}")
foreach(kernel IN LISTS kernels)
    string(REPLACE ", " "_" name "${kernel}")
    sivid_compiled_source(scalar_kernel_${name} "\
#include <sivid/paving/scalar_run.hpp>
#include <sivid/paving/detail/scalar_taylor_run.hpp>
namespace sivid::paving_detail {
template std::unique_ptr<experiment_run> make_scalar_taylor_run<${kernel}>(
    flow const&, experiment const&, record const&, run_options const&);
}
")
endforeach()

sivid_compiled_source(tube "\
#include <sivid/enclosure/tube.hpp>
namespace sivid {
template tube<interval> integrate(
    std::shared_ptr<flow const>, box const&, box const&, double, double, enclosure_options const&);
}
")

# What each source that links to the library asks for: the machine and the layouts that both were compiled for.
sivid_compiled_source(flags "\
#define SIVID_COMPILE_LIBRARY_FOR
#include <sivid/compiled.hpp>
#include <sivid/space/detail/compiled_eigen.hpp>
")

# Headers with functions that are compiled once; those of one floor share most of their code.
set(entries_number decimal decimal_output decimal_text kernel_trial)
set(entries_measurement signal)
set(entries_model bound_model describe effect effects expression graph graph_listing model to_dot unit)
set(entries_approximate fit/counterexample fit/fit simulate/named_steps)
set(entries_enclosure enclosed_motion failure flow)
set(entries_paving continued_run detail/response_judgement experiment_run holdout_inflation identify inflation
                   outlier_budget)
set(entries_paving_further identifiability online_identification)   # apart: together they need 2 GB
set(entries_paving_check scalar_run)
set(entries_diagnosis affected_problem diagnose diagnosis_run manoeuvre)
set(entries_io certificates_csv checkpoint checkpoint_reader dataset dataset_digest dataset_writer diagnosis_json exact_decimal
               explaining_motion identification_csv identification_json identification_reader input_error
               json_document model_names problem_digest problem_from_dataset same_problem text_file)
set(entries_report bar_chart candidate_chart channel_series comparison_plot diagnosis_figures diagnosis_page
                   diagnosis_plot_data diagnosis_report diagnosis_tables diagnosis_words escape heat_map
                   holdout_tables identifiability_words identification_page identification_parameters
                   identification_report identification_words interval_chart legend missing_rate_plot number_text page
                   paving_plot paving_projections paving_raster place_words plane_plot residual_plot rounded_decimal
                   svg table ticks time_plot)
foreach(group IN ITEMS number measurement model approximate enclosure paving paving_further paving_check diagnosis io report)
    string(REGEX REPLACE "_.*" "" floor "${group}")
    if(floor MATCHES "^(io|report)$" AND NOT TARGET sivid::${floor})
        continue()
    endif()
    set(macros "")
    set(includes "")
    foreach(header IN LISTS entries_${group})
        file(STRINGS "${sivid_include_dir}/sivid/${floor}/${header}.hpp" condition REGEX "SIVID_COMPILE_[A-Z_]+")
        string(REGEX MATCH "SIVID_COMPILE_[A-Z_]+" macro "${condition}")
        string(APPEND macros "#define ${macro}\n")
        string(APPEND includes "#include <sivid/${floor}/${header}.hpp>\n")
    endforeach()
    sivid_compiled_source(${group} "${macros}${includes}")
endforeach()

if(TARGET sivid::io)
    sivid_compiled_source(check "\
#define SIVID_COMPILE_IDENTIFICATION_CHECK
#include <sivid/io/identification_check.hpp>
namespace sivid {
template class identification_check<interval, interval>;
}
")
endif()

add_library(sivid_compiled STATIC EXCLUDE_FROM_ALL ${sivid_compiled_sources})
add_library(sivid::compiled ALIAS sivid_compiled)
target_compile_definitions(sivid_compiled PUBLIC SIVID_COMPILED)
foreach(component IN ITEMS sivid io report)
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
if(TARGET sivid::io AND SIVID_GMP AND SIVID_MPFR AND SIVID_MPFI AND SIVID_MPFI_INCLUDE)
    set(sivid_compiled_sources "")
    foreach(function IN ITEMS check_by_proven_functions check_in_multiprecision)
        string(TOUPPER "SIVID_COMPILE_${function}" macro)
        sivid_compiled_source(${function} "#define ${macro}\n#include <sivid/io/mp_identification_check.hpp>\n")
    endforeach()
    add_library(sivid_compiled_mpfi STATIC EXCLUDE_FROM_ALL ${sivid_compiled_sources})
    add_library(sivid::compiled_mpfi ALIAS sivid_compiled_mpfi)
    target_compile_definitions(sivid_compiled_mpfi PUBLIC SIVID_COMPILED_MPFI)
    target_include_directories(sivid_compiled_mpfi SYSTEM PUBLIC "${SIVID_MPFI_INCLUDE}")
    target_link_libraries(sivid_compiled_mpfi PUBLIC sivid_compiled "${SIVID_MPFI}" "${SIVID_MPFR}" "${SIVID_GMP}"
                          PRIVATE sivid::io)
endif()

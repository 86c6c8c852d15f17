# SPDX-License-Identifier: MIT
# sivid_kernels: the integrators behind identification, compiled once for all of sivid's own programs
# instead of in each of them. A user may do the same; without it everything comes from the headers.

set(sivid_kernel_sources "")
foreach(kernel "2,4" "3,4" "4,3" "6,2" "9,2" "12,2")
    string(REPLACE "," "_" name "${kernel}")
    set(source "${PROJECT_BINARY_DIR}/kernels/kernel_${name}.cpp")
    file(CONFIGURE OUTPUT "${source}" CONTENT [[
// SPDX-License-Identifier: MIT
#include <sivid/paving/continued_run.hpp>
namespace sivid::paving_detail {
template std::unique_ptr<experiment_run> make_taylor_run<@kernel@>(
    flow const&, experiment const&, record const&, run_options const&);
template std::unique_ptr<continued_run> make_taylor_continuation<@kernel@>(
    flow const&, double, enclosure_options const&);
}
]] @ONLY)
    list(APPEND sivid_kernel_sources "${source}")
endforeach()
add_library(sivid_kernels STATIC EXCLUDE_FROM_ALL ${sivid_kernel_sources})
target_link_libraries(sivid_kernels PRIVATE sivid_sivid)

# For the folders that are added from here on.
add_compile_definitions(SIVID_COMPILED_KERNELS)
link_libraries(sivid_kernels)

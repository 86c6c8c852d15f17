// SPDX-License-Identifier: MIT
#ifndef SIVID_PYTHON_CORE_HPP
#define SIVID_PYTHON_CORE_HPP

#include <pybind11/pybind11.h>

/// The parts of the module sivid._core, each in a source of its own.
namespace sivid_python {

void add_commands(pybind11::module_& m); ///< models, and commands with them
void add_data(pybind11::module_& m);     ///< arrays as data sets
void add_results(pybind11::module_& m);  ///< stored results as arrays

} // namespace sivid_python

#endif

// SPDX-License-Identifier: MIT
// sivid._core: what the package sivid for Python calls of the library. Users call the package.
#include "_core.hpp"

#include <sivid/app/program.hpp>
#include <sivid/version.hpp>

#include <exception>
#include <new>
#include <string>

namespace py = pybind11;

PYBIND11_MODULE(_core, m) {
    m.doc() = "What the package sivid calls of the library; users call the package.";
    m.attr("version") = std::string{sivid::version};
    static py::exception<void> bad_input(m, "Error", PyExc_ValueError);
    static py::exception<void> internal(m, "InternalError", PyExc_RuntimeError);
    bad_input.attr("__module__") = "sivid";
    internal.attr("__module__") = "sivid";
    bad_input.doc() = "Bad input, or what cannot be done, with the message of sivid's programs.";
    internal.doc() = "A fault of sivid itself.";
    // The same words as those of the programs. Exceptions of pybind11 have translators of their
    // own.
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            std::rethrow_exception(thrown);
        } catch (py::builtin_exception const&) {
            throw;
        } catch (py::error_already_set const&) {
            throw;
        } catch (std::exception const& e) {
            auto const failed = sivid::app::failure_of(e);
            auto const* const memory = dynamic_cast<std::bad_alloc const*>(&e);
            PyErr_SetString(memory != nullptr                      ? PyExc_MemoryError
                            : failed.code == sivid::app::bad_input ? bad_input.ptr()
                                                                   : internal.ptr(),
                            failed.words.c_str());
        }
    });
    sivid_python::add_commands(m);
    sivid_python::add_data(m);
    sivid_python::add_results(m);
}

// SPDX-License-Identifier: MIT
// Arrays as data sets: an import whose columns are in memory, as those of a MATLAB file are.
#include "_core.hpp"

#include <sivid/importing/import_writer.hpp>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace py = pybind11;

namespace sivid_python {

namespace {

template <class Kept, class Stored>
std::vector<Kept> numbers_of(py::array const& a) {
    auto const all = py::array_t<Stored, py::array::forcecast>::ensure(a);
    auto const at = all.template unchecked<1>();
    std::vector<Kept> result;
    result.reserve(static_cast<std::size_t>(at.shape(0)));
    for (py::ssize_t i = 0; i < at.shape(0); ++i) result.push_back(static_cast<Kept>(at(i)));
    return result;
}

/// One column. What holds no numbers is listed, so that messages can name it.
sivid::matlab_variable column_of(std::string name, py::array const& a) {
    sivid::matlab_variable v;
    v.name = std::move(name);
    v.about = py::str(a.dtype()).cast<std::string>();
    for (py::ssize_t i = 0; i < a.ndim(); ++i)
        v.about += (i == 0 ? " " : "x") + std::to_string(a.shape(i));
    v.columns = 1;
    if (a.ndim() != 1) return v;
    v.rows = static_cast<std::size_t>(a.shape(0));
    auto const kind = a.dtype().kind();
    bool const small = a.itemsize() <= 4;
    if (kind == 'f' && small) v.numbers = numbers_of<float, float>(a);
    if (kind == 'f' && !small && a.itemsize() <= 8) v.numbers = numbers_of<double, double>(a);
    if (kind == 'i') v.numbers = numbers_of<std::int64_t, std::int64_t>(a);
    if (kind == 'u') v.numbers = numbers_of<std::uint64_t, std::uint64_t>(a);
    return v;
}

using frame = std::map<std::string, py::array>;

/// @param mapping  in the format sivid-mapping-1, of sources of the kind matlab
/// @param frames   the columns of each "file" of the mapping
/// @returns the protocol
std::string import_arrays(std::string const& mapping, std::map<std::string, frame> const& frames,
                          std::filesystem::path const& folder) {
    std::map<std::string, sivid::matlab_file> files;
    for (auto const& [name, columns] : frames) {
        auto& file = files[name];
        file.name = name;
        for (auto const& [heading, numbers] : columns)
            file.variables.push_back(column_of(heading, numbers));
    }
    py::gil_scoped_release const others;
    sivid::import_tools tools;
    tools.read_matlab = [&files](auto const& file) { return files.at(file.string()); };
    auto const imported =
        sivid::import_dataset(sivid::import_mapping_from_text(mapping, "Data"), std::move(tools));
    sivid::write_import(imported, folder);
    return imported.protocol.text();
}

} // namespace

void add_data(py::module_& m) {
    m.def(
        "import_arrays",
        [](std::string const& mapping, std::map<std::string, frame> const& frames,
           std::string const& folder) { return import_arrays(mapping, frames, folder); },
        py::arg("mapping"), py::arg("frames"), py::arg("folder"));
}

} // namespace sivid_python

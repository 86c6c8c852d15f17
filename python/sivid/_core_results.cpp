// SPDX-License-Identifier: MIT
// The tables of stored results as arrays.
#include "_core.hpp"

#include <sivid/io/identification_reader.hpp>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace py = pybind11;

namespace sivid_python {

namespace {

using sivid::box_verdict;

/// The boxes of one kind as an array of shape (n, d, 2).
py::array_t<double> boxes_of(std::vector<sivid::paved_box> const& rows, box_verdict kind,
                             std::size_t sides) {
    auto const count =
        std::count_if(rows.begin(), rows.end(), [&](auto const& r) { return r.verdict == kind; });
    py::array_t<double> result({static_cast<std::size_t>(count), sides, std::size_t{2}});
    auto at = result.mutable_unchecked<3>();
    py::ssize_t i = 0;
    for (auto const& row : rows) {
        if (row.verdict != kind) continue;
        for (std::size_t j = 0; j < sides; ++j) {
            at(i, static_cast<py::ssize_t>(j), 0) = row.set[j].lower();
            at(i, static_cast<py::ssize_t>(j), 1) = row.set[j].upper();
        }
        ++i;
    }
    return result;
}

py::dict boxes_by_kind(std::vector<sivid::paved_box> const& rows, std::size_t sides) {
    py::dict result;
    result["inside"] = boxes_of(rows, box_verdict::inside, sides);
    result["undecided"] = boxes_of(rows, box_verdict::undecided, sides);
    result["pending"] = boxes_of(rows, box_verdict::pending, sides);
    return result;
}

py::dict read_identification(std::string const& folder) {
    auto const found = [&] {
        py::gil_scoped_release const others;
        return sivid::read_identification(folder);
    }();
    auto const sides = found.parameters.size();
    py::list names, units;
    py::array_t<double> hull({sides, std::size_t{2}});
    auto at = hull.mutable_unchecked<2>();
    for (std::size_t j = 0; j < sides; ++j) {
        auto const& p = found.parameters[j];
        bool const none = sivid::is_empty(p.range);
        double const nan = std::numeric_limits<double>::quiet_NaN();
        names.append(p.name);
        units.append(p.unit.empty() ? "1" : p.unit);
        at(static_cast<py::ssize_t>(j), 0) = none ? nan : p.range.lower();
        at(static_cast<py::ssize_t>(j), 1) = none ? nan : p.range.upper();
    }
    auto result = boxes_by_kind(found.rows, sides);
    result["names"] = names;
    result["units"] = units;
    result["hull"] = hull;
    if (found.products) {
        result["products"] = boxes_by_kind(found.products->rows, found.products->sides.size());
        result["products"]["names"] = found.products->sides;
    }
    return result;
}

} // namespace

void add_results(py::module_& m) {
    m.def("read_identification", &read_identification, py::arg("folder"));
}

} // namespace sivid_python

// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_IDENTITY_HPP
#define SIVID_CLUSTER_IDENTITY_HPP

#include <sivid/version.hpp>

#include <cmath>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

namespace sivid::cluster {

/// What must be the same wherever work is done, or results would not be those of one machine.
struct identity {
    struct part {
        std::string what, value, remedy;

        template <class Archive>
        void serialize(Archive& a, unsigned) {
            a& what& value& remedy;
        }
    };
    std::vector<part> parts;

    /// The first part in which another differs, or none.
    [[nodiscard]] part const* differing(identity const& other) const {
        for (std::size_t k = 0; k < parts.size(); ++k) {
            bool const same = k < other.parts.size() && parts[k].what == other.parts[k].what &&
                              parts[k].value == other.parts[k].value;
            if (!same) return &parts[k];
        }
        return nullptr;
    }
    template <class Archive>
    void serialize(Archive& a, unsigned) {
        a& parts;
    }
};

namespace identity_detail {

/// Of bytes: tells those that differ by chance, no forgery.
[[nodiscard]] inline std::string print_of(std::string const& bytes) {
    return std::to_string(std::hash<std::string>{}(bytes)) + "-" + std::to_string(bytes.size());
}
/// What the functions of the mathematical library give on this processor: the approximate parts
/// use them, and libraries choose among versions of them when a program starts.
[[nodiscard]] inline std::string values_of_functions() {
    std::vector<double> values;
    volatile double x = 0.37; // or the compiler would tell
    for (int k = 0; k < 64; ++k) {
        x = x + 0.61803398875;
        double const here = x;
        values.insert(values.end(),
                      {std::sin(here), std::cos(here), std::exp(here), std::log(here),
                       std::tan(here), std::atan(here), std::tanh(here), std::pow(here, 1.7),
                       std::sqrt(here), std::cbrt(here), std::hypot(here, 0.3)});
    }
    std::string bytes(values.size() * sizeof(double), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

} // namespace identity_detail

/// This program on this machine.
/// @cost  reads the program's file, once
[[nodiscard]] inline identity const& identity_of_program() {
    static identity const mine = [] {
        std::ifstream in{"/proc/self/exe", std::ios::binary};
        std::string const file{std::istreambuf_iterator<char>{in}, {}};
        return identity{{{"version of sivid", std::string{version}, "use one version of sivid"},
                         {"program", identity_detail::print_of(file),
                          "start all ranks from copies of one file"},
                         {"mathematical functions",
                          identity_detail::print_of(identity_detail::values_of_functions()),
                          "use machines with one kind of processor and one C library"}}};
    }();
    return mine;
}

} // namespace sivid::cluster

#endif

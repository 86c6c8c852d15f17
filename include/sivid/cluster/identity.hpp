// SPDX-License-Identifier: MIT
#ifndef SIVID_CLUSTER_IDENTITY_HPP
#define SIVID_CLUSTER_IDENTITY_HPP

#include <sivid/cluster/frame.hpp>
#include <sivid/cluster/wire.hpp>
#include <sivid/version.hpp>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace sivid::cluster {

/// What must be the same wherever work is done, or results would not be those of one machine.
struct identity {
    struct part {
        std::string what, value, remedy;
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
};

inline void put(wire_writer& out, identity const& who) {
    out.put(std::uint64_t{who.parts.size()});
    for (auto const& p : who.parts)
        out.put(std::string_view{p.what}).put(std::string_view{p.value});
}
/// @throws wire_error
[[nodiscard]] inline identity take_identity(wire_reader& in) {
    identity who;
    who.parts.resize(in.count(16));
    for (auto& p : who.parts) {
        p.what = in.text();
        p.value = in.text();
    }
    return who;
}

namespace identity_detail {

[[nodiscard]] inline std::string hex(std::uint64_t x) {
    std::string text;
    for (int shift = 60; shift >= 0; shift -= 4) text += "0123456789abcdef"[x >> shift & 15];
    return text;
}
/// Of a file, eight bytes at a time; no protection against forgery.
[[nodiscard]] inline std::string print_of(char const* file) {
    std::ifstream in{file, std::ios::binary};
    std::vector<char> bytes(std::size_t{1} << 16);
    std::uint64_t sum = 0xcbf29ce484222325U, size = 0;
    while (in.read(bytes.data(), static_cast<std::streamsize>(bytes.size())), in.gcount() > 0) {
        auto const got = static_cast<std::size_t>(in.gcount());
        for (std::size_t k = 0; k < got; k += 8) {
            std::uint64_t word = 0;
            for (std::size_t j = k; j < got && j < k + 8; ++j) {
                word = word << 8 | static_cast<unsigned char>(bytes[j]);
            }
            sum = std::rotl(sum ^ word, 23) * 0x9e3779b97f4a7c15U;
        }
        size += got;
    }
    return hex(sum) + "-" + std::to_string(size);
}
/// What the functions of the mathematical library give on this processor: the approximate parts
/// use them, and libraries choose among versions of them when a program starts.
[[nodiscard]] inline std::string print_of_functions() {
    wire_writer out;
    volatile double x = 0.37; // or the compiler would tell
    for (int k = 0; k < 64; ++k) {
        x = x + 0.61803398875;
        double const here = x;
        out.put(std::sin(here)).put(std::cos(here)).put(std::exp(here)).put(std::log(here));
        out.put(std::tan(here)).put(std::atan(here)).put(std::tanh(here)).put(std::pow(here, 1.7));
        out.put(std::sqrt(here)).put(std::cbrt(here)).put(std::hypot(here, 0.3));
    }
    return hex(frame_detail::sum_of(out.take()));
}

} // namespace identity_detail

/// This program on this machine.
/// @cost  reads the program's file once
[[nodiscard]] inline identity identity_of_program() {
    return {{{"messages", std::string{frame_detail::format}, "use one version of sivid"},
             {"version of sivid", std::string{version}, "use one version of sivid"},
             {"program", identity_detail::print_of("/proc/self/exe"),
              "start all ranks from copies of one file"},
             {"mathematical functions", identity_detail::print_of_functions(),
              "use machines with one kind of processor and one C library"}}};
}

} // namespace sivid::cluster

#endif

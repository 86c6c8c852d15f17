// SPDX-License-Identifier: MIT
// Reads the vector files and runs them through interval_traits of any type.
#ifndef SIVID_TESTS_CONFORMANCE_VECTORS_HPP
#define SIVID_TESTS_CONFORMANCE_VECTORS_HPP

#include "conformance/operations.hpp"

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace conformance {

struct vector_line {
    std::string text, operation;
    std::vector<std::string> arguments, results;
    double argument(std::size_t i) const { return std::strtod(arguments.at(i).c_str(), nullptr); }
    double result(std::size_t i) const { return std::strtod(results.at(i).c_str(), nullptr); }
};

/// The lines of a vector file.
/// @throws std::runtime_error  naming the file, where it has none
inline std::vector<vector_line> read_vectors(std::string const& path) {
    std::vector<vector_line> lines;
    std::ifstream in{path};
    for (std::string text; std::getline(in, text);) {
        if (text.empty() || text[0] == '#') continue;
        vector_line line{text, {}, {}, {}};
        std::istringstream words{text};
        words >> line.operation;
        bool right = false;
        for (std::string word; words >> word;) {
            if (word == "->")
                right = true;
            else
                (right ? line.results : line.arguments).push_back(word);
        }
        lines.push_back(std::move(line));
    }
    if (lines.empty()) throw std::runtime_error("no test vectors in '" + path + "'");
    return lines;
}

template <class I>
using unary_table = std::map<std::string, I (*)(I const&)>;
template <class I>
using binary_table = std::map<std::string, I (*)(I const&, I const&)>;

template <class I>
unary_table<I> unary_operations() {
    using o = operations<I>;
    return {{"neg", o::neg},     {"recip", o::recip}, {"sqr", o::sqr},     {"sqrt", o::sqrt},
            {"abs", o::abs},     {"exp", o::exp},     {"expm1", o::expm1}, {"log", o::log},
            {"log1p", o::log1p}, {"sin", o::sin},     {"cos", o::cos},     {"tan", o::tan},
            {"asin", o::asin},   {"acos", o::acos},   {"atan", o::atan},   {"sinh", o::sinh},
            {"cosh", o::cosh},   {"tanh", o::tanh},   {"asinh", o::asinh}, {"acosh", o::acosh},
            {"atanh", o::atanh}};
}
template <class I>
binary_table<I> binary_operations() {
    using o = operations<I>;
    return {
        {"add", o::add},     {"sub", o::sub},   {"mul", o::mul},
        {"div", o::div},     {"min", o::min},   {"max", o::max},
        {"pow", o::pow},     {"hull", o::hull}, {"intersection", o::intersection},
        {"atan2", o::atan2},
    };
}

/// Runs the lines whose result is an interval; tight results where `must_be_tight`.
template <class I>
void run_vectors(std::vector<vector_line> const& lines, report& r) {
    using o = operations<I>;
    auto const unary = unary_operations<I>();
    auto const binary = binary_operations<I>();
    for (auto const& line : lines) {
        bool const must = must_be_tight<I>(line.operation);
        auto const interval_at = [&](std::size_t i) {
            return o::make(line.argument(2 * i), line.argument(2 * i + 1));
        };
        auto const check = [&](I const& got) {
            r.result(line.text.c_str(), got, line.result(0), line.result(1), must);
        };
        if (auto const f = unary.find(line.operation); f != unary.end()) {
            check(f->second(interval_at(0)));
        } else if (auto const g = binary.find(line.operation); g != binary.end()) {
            check(g->second(interval_at(0), interval_at(1)));
        } else if (line.operation == "fma") {
            check(o::fma(interval_at(0), interval_at(1), interval_at(2)));
        } else if (line.operation == "pown") {
            check(o::pown(interval_at(0), std::atoi(line.arguments.at(2).c_str())));
        } else {
            ++r.skipped;
        }
    }
}

} // namespace conformance

#endif

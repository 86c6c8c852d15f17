// SPDX-License-Identifier: MIT
// What the generated literal tests need.
#ifndef SIVID_TESTS_CONFORMANCE_LITERALS_HPP
#define SIVID_TESTS_CONFORMANCE_LITERALS_HPP

#include "conformance/operations.hpp"

#include <concepts>
#include <iostream>

namespace conformance {

/// Tight results are demanded of the vocabulary type only.
template <class I>
bool must_be_tight(char const* name) {
    return std::same_as<I, sivid::interval> && is_tight(name);
}

/// Prints the failures; the exit code of the program.
inline int conclude(report const& r) {
    for (auto const& text : r.unsound) std::cout << "unsound: " << text << '\n';
    for (auto const& text : r.loose) std::cout << "not tight: " << text << '\n';
    std::cout << r.run << " literal vectors, " << r.unsound.size() << " unsound, " << r.loose.size()
              << " not tight\n";
    if (r.run == 0) std::cout << "skipped: the vector files are not part of the repository\n";
    return r.unsound.empty() && r.loose.empty() ? 0 : 1;
}

} // namespace conformance

#endif

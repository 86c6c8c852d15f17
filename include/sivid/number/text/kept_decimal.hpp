// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_TEXT_KEPT_DECIMAL_HPP
#define SIVID_NUMBER_TEXT_KEPT_DECIMAL_HPP

#include <sivid/number/decimal.hpp>

#include <mutex>
#include <set>
#include <string>

namespace sivid {

/// The decimal of a text, which is kept for as long as the program runs, as a `decimal` needs it;
/// each once.
/// @given  a number without a sign (trusted)
[[nodiscard]] inline decimal kept_decimal(std::string const& text) {
    static std::mutex one_at_a_time;
    static std::set<std::string> all;
    std::lock_guard const alone(one_at_a_time);
    auto const& own = *all.insert(text).first;
    return {own.c_str(), own.size(), false};
}

} // namespace sivid

#endif

// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPL_UNIT_IPP
#define SIVID_MODEL_IMPL_UNIT_IPP

#include <sivid/model/unit.hpp>

namespace sivid {

SIVID_DECL unit::unit(std::string_view text) {
    int sign = 1;
    std::size_t i = 0;
    while (i < text.size()) {
        if (text[i] == '/') {
            sign = -1;
            ++i;
        } else if (std::isalpha(static_cast<unsigned char>(text[i])) != 0) {
            std::string symbol;
            while (i < text.size() && std::isalpha(static_cast<unsigned char>(text[i])) != 0) {
                symbol += text[i++];
            }
            powers_[symbol] += sign * exponent(text, i);
        } else {
            ++i; // blanks, the number 1, parentheses
        }
    }
    drop_zeros();
}

SIVID_DECL unit unit::times(unit const& other, int n) const {
    unit result = *this;
    for (auto const& [symbol, power] : other.powers_) result.powers_[symbol] += n * power;
    result.drop_zeros();
    return result;
}

SIVID_DECL std::string unit::text() const {
    std::string above;
    std::string below;
    int divisors = 0;
    for (auto const& [symbol, power] : powers_) {
        auto& part = power > 0 ? above : below;
        int const size = power > 0 ? power : -power;
        if (!part.empty()) part += ' ';
        part += size == 1 ? symbol : symbol + "^" + std::to_string(size);
        divisors += power < 0 ? 1 : 0;
    }
    if (above.empty()) above = "1";
    if (below.empty()) return above;
    return above + "/" + (divisors > 1 ? "(" + below + ")" : below);
}

SIVID_DECL int unit::exponent(std::string_view text, std::size_t& i) {
    if (i >= text.size() || text[i] != '^') return 1;
    ++i;
    int sign = 1;
    if (i < text.size() && text[i] == '-') {
        sign = -1;
        ++i;
    }
    int n = 0;
    while (i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0 && n < 100) {
        n = 10 * n + (text[i++] - '0');
    }
    return sign * n;
}

SIVID_DECL void unit::drop_zeros() {
    for (auto it = powers_.begin(); it != powers_.end();) {
        it = it->second == 0 ? powers_.erase(it) : std::next(it);
    }
}

} // namespace sivid

#endif

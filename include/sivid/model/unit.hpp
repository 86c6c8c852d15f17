// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_UNIT_HPP
#define SIVID_MODEL_UNIT_HPP

#include <sivid/compiled.hpp>

#include <cctype>
#include <map>
#include <string>
#include <string_view>

namespace sivid {

/// A physical unit as powers of symbols: "kg m^2/s" is {kg: 1, m: 2, s: -1}. Everything after a
/// slash, up to the next one, divides; "1" is no symbol. No conversion, no check of the symbols.
class unit {
public:
    unit() = default;
    explicit unit(std::string_view text);

    /// The product with `other` to the power n.
    [[nodiscard]] unit times(unit const& other, int n) const;

    /// Positive powers first, for instance "kg m^2/s"; "1" without a unit.
    [[nodiscard]] std::string text() const;

    friend bool operator==(unit const&, unit const&) = default;

private:
    static int exponent(std::string_view text, std::size_t& i);
    void drop_zeros();

    std::map<std::string, int> powers_;
};

#if !defined(SIVID_COMPILED) || defined(SIVID_COMPILE_UNIT)
SIVID_ENTRY unit::unit(std::string_view text) {
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

SIVID_ENTRY unit unit::times(unit const& other, int n) const {
    unit result = *this;
    for (auto const& [symbol, power] : other.powers_) result.powers_[symbol] += n * power;
    result.drop_zeros();
    return result;
}

SIVID_ENTRY std::string unit::text() const {
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

SIVID_ENTRY int unit::exponent(std::string_view text, std::size_t& i) {
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

SIVID_ENTRY void unit::drop_zeros() {
    for (auto it = powers_.begin(); it != powers_.end();) {
        it = it->second == 0 ? powers_.erase(it) : std::next(it);
    }
}
#endif

} // namespace sivid

#endif

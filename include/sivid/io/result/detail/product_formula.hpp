// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_RESULT_DETAIL_PRODUCT_FORMULA_HPP
#define SIVID_IO_RESULT_DETAIL_PRODUCT_FORMULA_HPP

#include <sivid/space/box.hpp>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

/// A product of powers as result files write it: "L*Sg", "a^2/b", "1/(a*b^3)".
class product_formula {
public:
    /// @returns nothing when malformed, when a factor is none of the names, or for powers beyond
    /// 1000
    [[nodiscard]] static std::optional<product_formula>
    parse(std::string_view text, std::vector<std::string> const& names) {
        product_formula result;
        result.exponents_.assign(names.size(), 0);
        auto const slash = text.find('/');
        if (!result.add(text.substr(0, slash), 1, names)) return std::nullopt;
        if (slash == std::string_view::npos) return result;
        auto below = text.substr(slash + 1);
        if (below.size() >= 2 && below.front() == '(' && below.back() == ')')
            below = below.substr(1, below.size() - 2);
        if (!result.add(below, -1, names)) return std::nullopt;
        return result;
    }

    /// One per name.
    [[nodiscard]] std::vector<int> const& exponents() const { return exponents_; }

    /// The sum of all powers, those of divisors counted as they are.
    [[nodiscard]] int degree() const {
        int sum = 0;
        for (int const e : exponents_) sum += std::abs(e);
        return sum;
    }

    /// The same without one of the factors.
    [[nodiscard]] product_formula without(std::size_t j) const {
        auto rest = *this;
        rest.exponents_[j] = 0;
        return rest;
    }

    /// Encloses the range over a box; nothing when it is not defined there.
    template <class I>
    [[nodiscard]] std::optional<I> over(basic_box<I> const& p) const {
        using traits = interval_traits<I>;
        typename traits::mask undefined{};
        I above = traits::point(1.0), below = traits::point(1.0);
        for (std::size_t j = 0; j < exponents_.size(); ++j) {
            if (exponents_[j] == 0) continue;
            I const power = traits::pown(p[j], std::abs(exponents_[j]), undefined);
            I& side = exponents_[j] > 0 ? above : below;
            side = traits::mul(side, power);
        }
        I const value = traits::div(above, below, undefined);
        if (undefined) return std::nullopt;
        return value;
    }

private:
    bool add(std::string_view text, int sign, std::vector<std::string> const& names) {
        if (text == "1" && sign > 0) return true;
        while (true) {
            auto const end = std::min(text.find('*'), text.size());
            auto factor = text.substr(0, end);
            int power = 1;
            if (auto const hat = factor.find('^'); hat != std::string_view::npos) {
                auto const digits = factor.substr(hat + 1);
                auto const [stop, fault] =
                    std::from_chars(digits.data(), digits.data() + digits.size(), power);
                if (fault != std::errc{} || stop != digits.data() + digits.size() || power < 1 ||
                    power > most_power)
                    return false;
                factor = factor.substr(0, hat);
            }
            auto const found = std::find(names.begin(), names.end(), factor);
            if (found == names.end()) return false;
            auto& sum = exponents_[static_cast<std::size_t>(found - names.begin())];
            sum += sign * power;
            if (std::abs(sum) > most_power) return false;
            if (end == text.size()) return true;
            text.remove_prefix(end + 1);
        }
    }

    static constexpr int most_power = 1000;

    std::vector<int> exponents_;
};

/// Whether a text is a sum or difference of names, as `find_sums` writes them.
[[nodiscard]] inline bool is_sum_of(std::string_view text, std::vector<std::string> const& names) {
    if (text.substr(0, 1) == "-") text.remove_prefix(1);
    std::size_t terms = 0;
    while (true) {
        auto const end = std::min({text.find(" + "), text.find(" - "), text.size()});
        if (std::find(names.begin(), names.end(), text.substr(0, end)) == names.end()) return false;
        ++terms;
        if (end == text.size()) return terms > 1;
        text.remove_prefix(end + 3);
    }
}

} // namespace sivid

#endif // SIVID_IO_RESULT_DETAIL_PRODUCT_FORMULA_HPP

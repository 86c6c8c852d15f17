// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_UNIT_HPP
#define SIVID_MODEL_UNIT_HPP

#include <sivid/compiled.hpp>

#include <cctype>
#include <cstddef>
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

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/impl/unit.ipp>
#endif

#endif

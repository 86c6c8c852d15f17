// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_UNIT_HPP
#define SIVID_MODEL_UNIT_HPP

#include <sivid/compiled.hpp>

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace sivid {

/// A physical unit as powers of symbols: "kg m^2/s" is {kg: 1, m: 2, s: -1}. Symbols stand side by
/// side or with "*" or a middle dot between; everything after a slash, up to the next one or to the
/// end of the brackets, divides; "1", "-" and nothing are no symbol. Exponents: "^2", "^-2",
/// "^0.5", "^(1/3)".
///   Known for conversions (`in`): the base and derived units of the SI with their prefixes, g, t,
/// L, bar, min, h, d, %, and the angles rad, deg, rev, turn, rpm. Whatever else stands there
/// ("counts", "degC", "dB") is a unit of its own, which nothing but itself is converted to.
class unit {
public:
    /// \f$ 2^{two} \, 3^{three} \, 10^{ten} \, \pi^{pi} \f$: factors between units are of this
    /// form.
    struct ratio {
        int two = 0, three = 0, ten = 0, pi = 0;
        [[nodiscard]] bool is_one() const { return *this == ratio{}; }
        friend bool operator==(ratio const&, ratio const&) = default;
    };

    unit() = default;
    explicit unit(std::string_view text);

    /// What makes the text no unit, in words; empty: it is one. Whatever can be read of such a text
    /// is kept for `text`, and `in` converts nothing.
    [[nodiscard]] std::string const& fault() const { return fault_; }

    /// The product with `other` to the power n.
    [[nodiscard]] unit times(unit const& other, int n) const;

    /// The power above/below of it, below > 0: `power(1, 2)` of m^2 is m.
    /// @returns  nothing where a power of a symbol would not be a whole count of twelfths, or
    /// beyond
    ///           99
    [[nodiscard]] std::optional<unit> power(int above, int below = 1) const;

    /// Positive powers first, for instance "kg m^2/s"; "1" without a unit.
    [[nodiscard]] std::string text() const;

    /// How many of `other` one of this unit is, exactly: 1 deg is pi/180 rad.
    ///   rad is 1, so that both convert to each other by 1. What counts turns or cycles (rev, turn,
    /// rpm, Hz) is converted to angles as an angle, and to nothing that may be a count as well.
    /// Scales with another zero (degC and K) and logarithmic ones (dB) are units of their own.
    /// @returns  nothing for another dimension, for a text that is no unit, and where the factor is
    ///           not of the form of `ratio` (mV^0.5 in V^0.5)
    [[nodiscard]] std::optional<ratio> in(unit const& other) const;

    /// Whether both are the same powers of the same symbols.
    friend bool operator==(unit const& a, unit const& b) { return a.powers_ == b.powers_; }

private:
    friend class unit_reader;
    void drop_zeros();

    std::map<std::string, int> powers_; ///< in twelfths: roots have whole ones, too
    std::string fault_;
};

/// The unit of the rate of what has the unit `quantity`: "m/ms^2" for "m/ms" in a model whose unit
/// of time is ms.
[[nodiscard]] SIVID_DECL std::string rate_unit(std::string_view quantity, std::string_view time);

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/impl/unit.ipp>
#endif

#endif

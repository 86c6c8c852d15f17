// SPDX-License-Identifier: MIT
#ifndef SIVID_IMPORTING_ROBOT_WRITTEN_SCALAR_HPP
#define SIVID_IMPORTING_ROBOT_WRITTEN_SCALAR_HPP

#include <sivid/io/text/exact_decimal.hpp>

#include <cmath>
#include <string>
#include <utility>

namespace sivid {

/// A scalar whose operations write a formula, as models in text have them.
class written_scalar {
public:
    explicit written_scalar(double x)
        : text_(exact_decimal::shortest(std::abs(x)).text()), minus_(x < 0) {}
    /// A name.
    explicit written_scalar(std::string name) : text_(std::move(name)) {}

    [[nodiscard]] bool is_name() const { return kind_ == atom && !minus_; }
    [[nodiscard]] std::string text() const { return (minus_ ? "-" : "") + text_; }

    friend written_scalar operator-(written_scalar a) {
        if (a.kind_ == sum) return {"(" + a.text() + ")", atom, true};
        a.minus_ = !a.minus_;
        return a;
    }
    friend written_scalar operator+(written_scalar const& a, written_scalar const& b) {
        if (a.minus_ && a.kind_ != sum && !b.minus_) return b - -a;
        if (b.kind_ == sum && b.text_.front() == '-')
            return {a.text() + " + (" + b.text_ + ")", sum};
        return {a.text() + (b.minus_ ? " - " : " + ") + b.text_, sum};
    }
    friend written_scalar operator-(written_scalar const& a, written_scalar const& b) {
        if (b.kind_ == sum) return {a.text() + " - (" + b.text() + ")", sum};
        return b.minus_ ? a + -b : written_scalar{a.text() + " - " + b.text_, sum};
    }
    friend written_scalar operator*(written_scalar const& a, written_scalar const& b) {
        return product(a, b, "*", b.kind_ == sum);
    }
    friend written_scalar operator/(written_scalar const& a, written_scalar const& b) {
        return product(a, b, "/", b.kind_ != atom);
    }
    friend written_scalar sin(written_scalar const& a) { return {"sin(" + a.text() + ")", call}; }
    friend written_scalar cos(written_scalar const& a) { return {"cos(" + a.text() + ")", call}; }

private:
    enum kind { sum, call, atom };

    written_scalar(std::string text, kind of, bool minus = false)
        : text_(std::move(text)), kind_(of), minus_(minus) {}

    static written_scalar product(written_scalar const& a, written_scalar const& b,
                                  char const* sign, bool brackets) {
        if (a.text_ == "1" && *sign == '*') return a.minus_ ? -b : b;
        if (b.text_ == "1") return b.minus_ ? -a : a;
        bool const minus = a.minus_ != (b.minus_ && !brackets);
        auto const left = a.kind_ == sum ? "(" + a.text() + ")" : a.text_;
        auto const right = brackets ? "(" + b.text() + ")" : b.text_;
        return {left + sign + right, call, minus};
    }

    std::string text_; ///< without the sign
    kind kind_ = atom; ///< `call`: a product or a call
    bool minus_ = false;
};

} // namespace sivid

#endif

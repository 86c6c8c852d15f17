// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_TEXT_IMPL_EXACT_DECIMAL_IPP
#define SIVID_IO_TEXT_IMPL_EXACT_DECIMAL_IPP

#include <sivid/io/text/exact_decimal.hpp>

#include <charconv>
#include <cmath>
#include <cstdint>

#include <boost/multiprecision/cpp_int.hpp>

namespace sivid {

/// Decimals as whole numbers of units 10^exponent.
struct exact_decimal::wholes {
    using number = boost::multiprecision::cpp_int;

    [[nodiscard]] static exact_decimal decimal(number const& whole, long exponent) {
        exact_decimal result;
        result.negative_ = whole < 0;
        result.digits_ = whole.str();
        if (result.negative_) result.digits_.erase(0, 1);
        result.exponent_ = exponent;
        result.normalise();
        return result;
    }

    /// x 10^-exponent, for an exponent not above that of x.
    [[nodiscard]] static number of(exact_decimal const& x, long exponent) {
        if (x.is_zero()) return 0;
        auto const zeros = static_cast<std::size_t>(x.exponent_ - exponent);
        number const size{x.digits_ + std::string(zeros, '0')};
        return x.negative_ ? number{-size} : size;
    }
    [[nodiscard]] static number of(exact_decimal const& x) { return of(x, x.exponent_); }
};

SIVID_DECL std::optional<exact_decimal> exact_decimal::parse(std::string_view text) {
    exact_decimal result;
    if (!text.empty() && (text.front() == '+' || text.front() == '-')) {
        result.negative_ = text.front() == '-';
        text.remove_prefix(1);
    }
    bool any_digit = false, after_point = false;
    while (!text.empty()) {
        char const c = text.front();
        if (c >= '0' && c <= '9') {
            result.digits_ += c;
            any_digit = true;
            if (after_point) --result.exponent_;
        } else if (c == '.' && !after_point) {
            after_point = true;
        } else {
            break;
        }
        text.remove_prefix(1);
    }
    if (!any_digit) return std::nullopt;
    long stated = 0;
    if (!text.empty()) {
        if (text.front() != 'e' && text.front() != 'E') return std::nullopt;
        text.remove_prefix(1);
        if (!text.empty() && text.front() == '+') {
            text.remove_prefix(1);
            if (!text.empty() && text.front() == '-') return std::nullopt;
        }
        auto const [end, fault] = std::from_chars(text.data(), text.data() + text.size(), stated);
        if (end != text.data() + text.size() || text.empty()) return std::nullopt;
        if (fault != std::errc{}) return std::nullopt;
    }
    result.normalise();
    if (result.is_zero()) return exact_decimal{};
    if (result.digits_.size() > most_digits || std::abs(stated) > largest_exponent)
        return std::nullopt;
    result.exponent_ += stated;
    if (std::abs(result.exponent_) > 2 * largest_exponent) return std::nullopt;
    return result;
}

SIVID_DECL exact_decimal exact_decimal::shortest(double value) {
    char buffer[64];
    auto const end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
    return parse({buffer, static_cast<std::size_t>(end - buffer)}).value_or(exact_decimal{});
}

SIVID_DECL exact_decimal exact_decimal::of(double value) {
    // value = f 2^e has its last bit at 2^(e - 53): so many places, less the zeros in front.
    int e = 0;
    (void)std::frexp(value, &e);
    int const digits = std::max(53 - e, 0) + static_cast<int>(std::floor(0.30103 * e)) + 3;
    char buffer[800];
    auto const end = std::to_chars(buffer, buffer + sizeof buffer, value,
                                   std::chars_format::scientific, std::clamp(digits, 17, 766))
                         .ptr;
    return parse({buffer, static_cast<std::size_t>(end - buffer)}).value_or(exact_decimal{});
}

SIVID_DECL exact_decimal exact_decimal::rounded(double value, int places) {
    char buffer[700];
    auto const end =
        std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, places).ptr;
    return parse({buffer, static_cast<std::size_t>(end - buffer)}).value_or(exact_decimal{});
}

SIVID_DECL exact_decimal exact_decimal::sum(exact_decimal const& a, exact_decimal const& b) {
    auto const exponent = std::min(a.exponent_, b.exponent_);
    return wholes::decimal(wholes::of(a, exponent) + wholes::of(b, exponent), exponent);
}

SIVID_DECL exact_decimal exact_decimal::times(std::size_t n) const {
    return wholes::decimal(wholes::of(*this) * n, exponent_);
}

SIVID_DECL exact_decimal exact_decimal::times(exact_decimal const& y) const {
    return wholes::decimal(wholes::of(*this) * wholes::of(y), exponent_ + y.exponent_);
}

SIVID_DECL std::pair<exact_decimal, exact_decimal>
exact_decimal::divided_by(std::size_t n, std::size_t digits) const {
    // Zeros enough that the quotient has all digits wanted; those beyond are cut off.
    auto exponent = exponent_ - static_cast<long>(digits + std::to_string(n).size());
    auto const size = wholes::of(negative_ ? -*this : *this, exponent);
    wholes::number divisor = n, near = size / divisor;
    if (auto const found = near.str().size(); found > digits) {
        auto const beyond = found - digits;
        divisor *= pow(wholes::number{10}, static_cast<unsigned>(beyond));
        near = size / divisor;
        exponent += static_cast<long>(beyond);
    }
    wholes::number far = near;
    if (near * divisor != size) ++far;
    auto const a = wholes::decimal(near, exponent), b = wholes::decimal(far, exponent);
    return negative_ ? std::pair{-b, -a} : std::pair{a, b};
}

SIVID_DECL std::size_t exact_decimal::floor() const {
    if (negative_ || !is_below_power_of_ten(19)) return 0;
    if (exponent_ >= 0) return whole().value_or(0);
    auto const cut = static_cast<std::size_t>(-exponent_);
    auto const kept = digits_.size() - std::min(cut, digits_.size());
    std::size_t result = 0;
    std::from_chars(digits_.data(), digits_.data() + kept, result);
    return result;
}

SIVID_DECL std::string exact_decimal::text() const {
    if (is_zero()) return "0";
    std::string const sign = negative_ ? "-" : "";
    auto const count = static_cast<long>(digits_.size());
    if (exponent_ >= 0 && count + exponent_ <= 17)
        return sign + digits_ + std::string(static_cast<std::size_t>(exponent_), '0');
    if (exponent_ < 0 && count + exponent_ > 0) {
        auto const whole = static_cast<std::size_t>(count + exponent_);
        return sign + digits_.substr(0, whole) + "." + digits_.substr(whole);
    }
    if (exponent_ < 0 && count + exponent_ > -6)
        return sign + "0." + std::string(static_cast<std::size_t>(-(count + exponent_)), '0') +
               digits_;
    auto const fraction = digits_.substr(1);
    return sign + digits_.substr(0, 1) + (fraction.empty() ? "" : "." + fraction) + "e" +
           std::to_string(exponent_ + count - 1);
}

SIVID_DECL detail::number_text exact_decimal::taken_apart() const {
    detail::number_text n;
    n.valid = true;
    n.negative = negative_;
    n.digit_count = digits_.size();
    n.point = exponent_ + static_cast<long>(digits_.size());
    return n;
}

SIVID_DECL void exact_decimal::normalise() {
    digits_.erase(0, std::min(digits_.find_first_not_of('0'), digits_.size()));
    auto const last = digits_.find_last_not_of('0');
    if (last == std::string::npos) {
        *this = exact_decimal{};
        return;
    }
    exponent_ += static_cast<long>(digits_.size() - last - 1);
    digits_.resize(last + 1);
}

SIVID_DECL std::optional<interval> enclose(exact_decimal const& x) {
    auto const bound = detail::enclose_text(x.digits_, x.taken_apart(), x.negative_);
    return is_bounded(bound) ? std::optional{bound} : std::nullopt;
}

SIVID_DECL std::optional<interval> enclose(exact_decimal const& lower, exact_decimal const& upper) {
    auto const a = enclose(lower), b = enclose(upper);
    if (!a || !b) return std::nullopt;
    return hull(*a, *b);
}

SIVID_DECL std::optional<double> nearest(exact_decimal const& x) {
    double const near = detail::nearest_text(x.digits_, x.taken_apart(), x.negative_);
    return detail::is_infinite(near) ? std::nullopt : std::optional{near};
}

} // namespace sivid

#endif

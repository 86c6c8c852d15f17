// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_TEXT_IMPL_EXACT_DECIMAL_IPP
#define SIVID_IO_TEXT_IMPL_EXACT_DECIMAL_IPP

#include <sivid/io/text/exact_decimal.hpp>

#include <cmath>
#include <cstdint>

namespace sivid {

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

SIVID_DECL exact_decimal exact_decimal::sum_of_short(exact_decimal const& a, exact_decimal const& b,
                                                     std::string const& x, std::string const& y,
                                                     long exponent) {
    auto const signed_whole = [](std::string const& digits, bool negative) {
        std::int64_t n = 0; // of no digits: zero
        std::from_chars(digits.data(), digits.data() + digits.size(), n);
        return negative ? -n : n;
    };
    auto const total = signed_whole(x, a.negative_) + signed_whole(y, b.negative_);
    exact_decimal result;
    result.exponent_ = exponent;
    result.negative_ = total < 0;
    result.digits_ = std::to_string(total < 0 ? -total : total);
    result.normalise();
    return result;
}

SIVID_DECL exact_decimal exact_decimal::sum(exact_decimal const& a, exact_decimal const& b) {
    auto const exponent = std::min(a.exponent_, b.exponent_);
    auto x = a.digits_at(exponent), y = b.digits_at(exponent);
    if (x.size() <= 17 && y.size() <= 17) return sum_of_short(a, b, x, y, exponent);
    auto const width = std::max(x.size(), y.size()) + 1;
    x.insert(0, width - x.size(), '0');
    y.insert(0, width - y.size(), '0');

    exact_decimal result;
    result.exponent_ = exponent;
    if (a.negative_ == b.negative_) {
        result.negative_ = a.negative_;
        result.digits_ = combine(x, y, +1);
    } else if (x >= y) { // same length: text order is number order
        result.negative_ = a.negative_;
        result.digits_ = combine(x, y, -1);
    } else {
        result.negative_ = b.negative_;
        result.digits_ = combine(y, x, -1);
    }
    result.normalise();
    return result;
}

SIVID_DECL exact_decimal exact_decimal::times(std::size_t n) const {
    exact_decimal y;
    y.digits_ = std::to_string(n);
    y.normalise();
    return times(y);
}

SIVID_DECL exact_decimal exact_decimal::times(exact_decimal const& y) const {
    exact_decimal result;
    if (is_zero() || y.is_zero()) return result;
    std::vector<unsigned> sums(digits_.size() + y.digits_.size(), 0); // last digit first
    for (std::size_t i = 0; i < digits_.size(); ++i) {
        auto const d = static_cast<unsigned>(digits_[digits_.size() - 1 - i] - '0');
        for (std::size_t j = 0; j < y.digits_.size(); ++j)
            sums[i + j] += d * static_cast<unsigned>(y.digits_[y.digits_.size() - 1 - j] - '0');
    }
    for (std::size_t i = 0; i + 1 < sums.size(); ++i) {
        sums[i + 1] += sums[i] / 10;
        sums[i] %= 10;
    }
    for (auto s = sums.rbegin(); s != sums.rend(); ++s)
        result.digits_ += static_cast<char>('0' + *s);
    result.negative_ = negative_ != y.negative_;
    result.exponent_ = exponent_ + y.exponent_;
    result.normalise();
    return result;
}

SIVID_DECL std::pair<exact_decimal, exact_decimal>
exact_decimal::divided_by(std::size_t n, std::size_t digits) const {
    exact_decimal near;
    if (is_zero()) return {near, near};
    near.negative_ = negative_;
    near.exponent_ = exponent_ + static_cast<long>(digits_.size());
    std::size_t rest = 0, i = 0;
    while ((i < digits_.size() || rest != 0) && near.digits_.size() < digits) {
        rest = rest * 10 + (i < digits_.size() ? static_cast<std::size_t>(digits_[i] - '0') : 0);
        ++i;
        --near.exponent_;
        if (!near.digits_.empty() || rest >= n) near.digits_ += static_cast<char>('0' + rest / n);
        rest %= n;
    }
    bool const exact = rest == 0 && i >= digits_.size();
    exact_decimal last; // one unit of the last digit, away from zero
    last.negative_ = negative_;
    last.digits_ = "1";
    last.exponent_ = near.exponent_;
    near.normalise();
    if (exact) return {near, near};
    auto const far = near + last;
    return negative_ ? std::pair{far, near} : std::pair{near, far};
}

SIVID_DECL std::size_t exact_decimal::floor() const {
    if (is_zero() || negative_) return 0;
    auto whole = digits_;
    if (exponent_ >= 0) {
        whole.append(static_cast<std::size_t>(exponent_), '0');
    } else {
        auto const cut = static_cast<std::size_t>(-exponent_);
        if (cut >= whole.size()) return 0;
        whole.resize(whole.size() - cut);
    }
    std::size_t result = 0;
    std::from_chars(whole.data(), whole.data() + whole.size(), result);
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

SIVID_DECL std::string exact_decimal::combine(std::string const& x, std::string const& y,
                                              int sign) {
    std::string result(x.size(), '0');
    int carry = 0;
    for (auto i = x.size(); i-- > 0;) {
        int digit = (x[i] - '0') + sign * (y[i] - '0') + carry;
        carry = digit < 0 ? -1 : digit / 10;
        digit -= 10 * carry;
        result[i] = static_cast<char>('0' + digit);
    }
    return result;
}

SIVID_DECL std::string exact_decimal::digits_at(long exponent) const {
    if (is_zero()) return {};
    return digits_ + std::string(static_cast<std::size_t>(exponent_ - exponent), '0');
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

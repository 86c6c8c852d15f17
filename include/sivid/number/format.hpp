// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_FORMAT_HPP
#define SIVID_NUMBER_FORMAT_HPP

/// @file
/// Intervals in fmt; optional, needs fmt. "{}" writes the shortest bounds, "{:.4}" at most four
/// significant digits in each, both outward; fill, alignment and width apply to the whole text
/// ("{:>30.4}").

#include <sivid/number/decimal.hpp>
#include <sivid/number/decimal_output.hpp>
#include <sivid/number/interval.hpp>

#include <fmt/format.h>

#include <cstddef>
#include <string>

template <>
struct fmt::formatter<sivid::interval> {
    constexpr auto parse(fmt::format_parse_context& context) {
        auto at = context.begin();
        auto const end = context.end();
        auto const is_align = [](char c) { return c == '<' || c == '>' || c == '^'; };
        auto const is_digit = [&] { return at != end && *at >= '0' && *at <= '9'; };
        auto const number = [&] {
            int value = 0;
            for (; is_digit() && value < 1000; ++at) value = value * 10 + (*at - '0');
            return value;
        };
        if (at != end && *at != '}' && at + 1 != end && is_align(at[1])) fill_ = *at++;
        if (at != end && is_align(*at)) align_ = *at++;
        width_ = static_cast<std::size_t>(number());
        if (at != end && *at == '.') {
            ++at;
            if (!is_digit()) throw fmt::format_error("interval: digits expected after '.'");
            digits_ = number();
            if (digits_ == 0) throw fmt::format_error("interval: at least one digit");
        }
        if (at != end && *at != '}') throw fmt::format_error("interval: unknown format");
        return at;
    }

    template <class Context>
    auto format(sivid::interval const& x, Context& context) const {
        std::string const text = digits_ > 0 ? sivid::to_string(x, digits_) : sivid::to_string(x);
        std::size_t const missing = width_ > text.size() ? width_ - text.size() : 0;
        std::size_t const before = align_ == '>' ? missing : align_ == '^' ? missing / 2 : 0;
        return fmt::format_to(context.out(), "{}{}{}", std::string(before, fill_), text,
                              std::string(missing - before, fill_));
    }

private:
    char fill_ = ' ', align_ = '<';
    std::size_t width_ = 0;
    int digits_ = 0; ///< 0: shortest
};

#endif

// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPL_UNIT_IPP
#define SIVID_MODEL_IMPL_UNIT_IPP

#include <sivid/model/unit.hpp>

#include <array>
#include <cctype>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

namespace sivid {

namespace model_detail {

inline constexpr int whole_power = 12; ///< of a symbol, as `unit` counts

/// What a symbol means: powers of m, kg, s, A, K, mol, cd, rad, and how many of these it is.
struct unit_meaning {
    std::array<int, 8> dimension{};
    unit::ratio size{};
    bool counts = false; ///< turns or cycles, which "1" may mean as well
};

struct known_unit {
    char const* symbol;
    unit_meaning meaning;
    bool prefixes = true;
};

inline constexpr known_unit known_units[] = {
    {"m", {{1}}},
    {"g", {{0, 1}, {0, 0, -3, 0}}},
    {"s", {{0, 0, 1}}},
    {"A", {{0, 0, 0, 1}}},
    {"K", {{0, 0, 0, 0, 1}}},
    {"mol", {{0, 0, 0, 0, 0, 1}}},
    {"cd", {{0, 0, 0, 0, 0, 0, 1}}},
    {"rad", {{0, 0, 0, 0, 0, 0, 0, 1}}},
    {"sr", {{0, 0, 0, 0, 0, 0, 0, 2}}},
    {"Hz", {{0, 0, -1}, {}, true}},
    {"N", {{1, 1, -2}}},
    {"Pa", {{-1, 1, -2}}},
    {"J", {{2, 1, -2}}},
    {"W", {{2, 1, -3}}},
    {"C", {{0, 0, 1, 1}}},
    {"V", {{2, 1, -3, -1}}},
    {"F", {{-2, -1, 4, 2}}},
    {"ohm", {{2, 1, -3, -2}}},
    {"Ohm", {{2, 1, -3, -2}}},
    {"\xCE\xA9", {{2, 1, -3, -2}}},     // Greek capital omega
    {"\xE2\x84\xA6", {{2, 1, -3, -2}}}, // the sign of the unit
    {"S", {{-2, -1, 3, 2}}},
    {"Wb", {{2, 1, -2, -1}}},
    {"T", {{0, 1, -2, -1}}},
    {"H", {{2, 1, -2, -2}}},
    {"lm", {{0, 0, 0, 0, 0, 0, 1, 2}}},
    {"lx", {{-2, 0, 0, 0, 0, 0, 1, 2}}},
    {"L", {{3}, {0, 0, -3, 0}}},
    {"l", {{3}, {0, 0, -3, 0}}},
    {"bar", {{-1, 1, -2}, {0, 0, 5, 0}}},
    {"t", {{0, 1}, {0, 0, 3, 0}}, false},
    {"%", {{}, {0, 0, -2, 0}}, false},
    {"min", {{0, 0, 1}, {1, 1, 1, 0}}, false},
    {"h", {{0, 0, 1}, {2, 2, 2, 0}}, false},
    {"d", {{0, 0, 1}, {5, 3, 2, 0}}, false},
    {"deg", {{0, 0, 0, 0, 0, 0, 0, 1}, {-1, -2, -1, 1}}, false},
    {"\xC2\xB0", {{0, 0, 0, 0, 0, 0, 0, 1}, {-1, -2, -1, 1}}, false}, // the sign of degrees
    {"rev", {{0, 0, 0, 0, 0, 0, 0, 1}, {1, 0, 0, 1}, true}, false},
    {"turn", {{0, 0, 0, 0, 0, 0, 0, 1}, {1, 0, 0, 1}, true}, false},
    {"rpm", {{0, 0, -1, 0, 0, 0, 0, 1}, {0, -1, -1, 1}, true}, false},
};

struct unit_prefix {
    char const* symbol;
    int ten;
};

inline constexpr unit_prefix unit_prefixes[] = {{"da", 1},        {"h", 2},   {"k", 3},
                                                {"M", 6},         {"G", 9},   {"T", 12},
                                                {"P", 15},        {"E", 18},  {"d", -1},
                                                {"c", -2},        {"m", -3},  {"u", -6},
                                                {"\xC2\xB5", -6}, // the sign micro
                                                {"\xCE\xBC", -6}, // Greek mu
                                                {"n", -9},        {"p", -12}, {"f", -15},
                                                {"a", -18}};

/// What a symbol means, with a prefix or without; nothing: it is a unit of its own.
[[nodiscard]] inline std::optional<unit_meaning> meaning_of(std::string_view symbol) {
    for (auto const& known : known_units)
        if (symbol == known.symbol) return known.meaning;
    for (auto const& p : unit_prefixes) {
        std::string_view const prefix = p.symbol;
        if (!symbol.starts_with(prefix)) continue;
        for (auto const& known : known_units) {
            if (!known.prefixes || symbol.substr(prefix.size()) != known.symbol) continue;
            auto meaning = known.meaning;
            meaning.size.ten += p.ten;
            return meaning;
        }
    }
    return std::nullopt;
}

/// The power without its twelfths: "2", "0.5", "(1/3)".
[[nodiscard]] inline std::string power_text(int twelfths) {
    constexpr int quarter = whole_power / 4;
    if (twelfths % whole_power == 0) return std::to_string(twelfths / whole_power);
    if (twelfths % quarter == 0) {
        constexpr std::array<char const*, 4> parts{"", ".25", ".5", ".75"};
        return std::to_string(twelfths / whole_power) +
               parts[static_cast<std::size_t>(twelfths % whole_power / quarter)];
    }
    int top = twelfths, below = whole_power;
    for (int const factor : {2, 2, 3}) {
        if (top % factor != 0 || below % factor != 0) continue;
        top /= factor;
        below /= factor;
    }
    return "(" + std::to_string(top) + "/" + std::to_string(below) + ")";
}

} // namespace model_detail

/// Reads the text of a unit into powers; the constructor of `unit` uses it.
class unit_reader {
public:
    unit_reader(unit& to, std::string_view text) : to_(&to), text_(text) {}

    void operator()() {
        constexpr std::size_t longest = 100; // characters; brackets are read by recursion
        if (text_.size() > longest) {
            fail("it has more than 100 characters");
            return;
        }
        if (text_ == "-") return;
        product(1);
        if (i_ < text_.size()) fail("a bracket closes that is not open");
        to_->drop_zeros();
    }

private:
    static constexpr int largest_power = 99;

    void fail(std::string why) {
        if (to_->fault_.empty()) to_->fault_ = std::move(why);
    }
    [[nodiscard]] bool take(std::string_view what) {
        if (!text_.substr(i_).starts_with(what)) return false;
        i_ += what.size();
        return true;
    }
    [[nodiscard]] static bool is_digit(char c) { return c >= '0' && c <= '9'; }
    /// A letter, an underscore, % or part of a character beyond ASCII.
    [[nodiscard]] static bool is_letter(char c) {
        auto const byte = static_cast<unsigned char>(c);
        return std::isalpha(byte) != 0 || c == '_' || c == '%' || byte >= 0x80;
    }

    /// Up to the end, or to the bracket that closes.
    /// @param sign  of the powers, before the first slash
    void product(int sign) {
        int now = sign, divisors = 0;
        bool apart = false; // whether a sign stands in front of what follows
        std::string unknown;
        while (i_ < text_.size() && text_[i_] != ')') {
            if (take(" ")) continue;
            if (take("*") || take("\xC2\xB7") || take("\xE2\x8B\x85")) { // middle dots
                apart = true;
                continue;
            }
            if (take("/")) {
                now = -sign;
                divisors = 0;
                apart = true;
                continue;
            }
            if (now != sign && ++divisors > 1)
                fail("what the slash divides by is not clear; write brackets around it");
            if (take("(")) {
                product(now);
                if (!take(")")) fail("a bracket does not close");
                if (i_ < text_.size() && text_[i_] == '^') fail("a power of brackets");
                unknown.clear();
            } else {
                factor(now, apart, unknown);
            }
            apart = false;
        }
        if (apart) fail("a symbol is missing at the end");
    }

    /// @param apart    whether a sign stands in front of it
    /// @param unknown  the symbol before, if it is one of no known unit; receives this one
    void factor(int sign, bool apart, std::string& unknown) {
        if (text_[i_] == '1' && (i_ + 1 == text_.size() || !is_digit(text_[i_ + 1]))) {
            ++i_;
            unknown.clear();
            return;
        }
        if (!is_letter(text_[i_])) {
            fail("'" + std::string(1, text_[i_]) + "' is no part of a unit");
            ++i_;
            return;
        }
        auto const begin = i_;
        while (i_ < text_.size() && (is_letter(text_[i_]) || is_digit(text_[i_])) && !dot_here())
            ++i_;
        std::string const symbol(text_.substr(begin, i_ - begin));
        bool const is_known = model_detail::meaning_of(symbol).has_value();
        if (!is_known && !apart && !unknown.empty())
            fail("neither '" + unknown + "' nor '" + symbol + "' is known");
        unknown = is_known ? std::string{} : symbol;
        auto& power = to_->powers_[symbol];
        power += sign * exponent();
        if (std::abs(power) > largest_power * model_detail::whole_power) {
            fail("a power is beyond 99");
            power = 0;
        }
    }
    /// A middle dot, or a raised 2 or 3.
    [[nodiscard]] bool dot_here() const {
        auto const rest = text_.substr(i_);
        return rest.starts_with("\xC2\xB7") || rest.starts_with("\xE2\x8B\x85") ||
               rest.starts_with("\xC2\xB2") || rest.starts_with("\xC2\xB3");
    }

    /// In twelfths.
    [[nodiscard]] int exponent() {
        using model_detail::whole_power;
        if (take("\xC2\xB2")) return 2 * whole_power;
        if (take("\xC2\xB3")) return 3 * whole_power;
        if (!take("^")) return whole_power;
        bool const brackets = take("(");
        int const sign = take("-") ? -1 : 1;
        int result = whole() * whole_power;
        if (take(".")) {
            int part = 0, size = 1;
            for (; i_ < text_.size() && is_digit(text_[i_]) && size < 10'000; ++i_, size *= 10)
                part = 10 * part + (text_[i_] - '0');
            if (size == 1 || part * whole_power % size != 0) fail("a power is no half or quarter");
            result += part * whole_power / size;
        } else if (brackets && take("/")) {
            int const below = whole();
            if (below == 0 || result % below != 0) fail("a power has no divisor of 12 below");
            result = below == 0 ? 0 : result / below;
        }
        if (brackets && !take(")")) fail("a bracket does not close");
        return sign * result;
    }
    [[nodiscard]] int whole() {
        if (i_ == text_.size() || !is_digit(text_[i_])) fail("a power is no number");
        int n = 0;
        while (i_ < text_.size() && is_digit(text_[i_]) && n <= largest_power)
            n = 10 * n + (text_[i_++] - '0');
        return n;
    }

    unit* to_;
    std::string_view text_;
    std::size_t i_ = 0;
};

SIVID_DECL unit::unit(std::string_view text) { unit_reader(*this, text)(); }

SIVID_DECL unit unit::times(unit const& other, int n) const {
    unit result = *this;
    for (auto const& [symbol, power] : other.powers_) result.powers_[symbol] += n * power;
    if (result.fault_.empty()) result.fault_ = other.fault_;
    result.drop_zeros();
    return result;
}

SIVID_DECL std::optional<unit> unit::power(int above, int below) const {
    auto result = *this;
    for (auto& [symbol, power] : result.powers_) {
        auto const raised = static_cast<long long>(power) * above;
        constexpr long long most = 99LL * model_detail::whole_power;
        if (raised % below != 0 || std::llabs(raised / below) > most) return std::nullopt;
        power = static_cast<int>(raised / below);
    }
    result.drop_zeros();
    return result;
}

SIVID_DECL std::string unit::text() const {
    std::string above;
    std::string below;
    int divisors = 0;
    for (auto const& [symbol, power] : powers_) {
        auto& part = power > 0 ? above : below;
        auto const size = model_detail::power_text(std::abs(power));
        if (!part.empty()) part += ' ';
        part += size == "1" ? symbol : symbol + "^" + size;
        divisors += power < 0 ? 1 : 0;
    }
    if (above.empty()) above = "1";
    if (below.empty()) return above;
    return above + "/" + (divisors > 1 ? "(" + below + ")" : below);
}

SIVID_DECL std::optional<unit::ratio> unit::in(unit const& other) const {
    if (!fault_.empty() || !other.fault_.empty()) return std::nullopt;
    // In twelfths, as the powers are.
    std::array<long, 8> dimension{};
    std::array<long, 4> size{};
    std::map<std::string, int> own; // symbols that nothing is known of
    bool counts = false;
    auto const add = [&](unit const& u, int sign) {
        for (auto const& [symbol, power] : u.powers_) {
            auto const known = model_detail::meaning_of(symbol);
            if (!known) {
                own[symbol] += sign * power;
                continue;
            }
            long const n = sign * power;
            for (std::size_t k = 0; k < dimension.size(); ++k)
                dimension[k] += n * known->dimension[k];
            auto const& [two, three, ten, pi] = known->size;
            size = {size[0] + n * two, size[1] + n * three, size[2] + n * ten, size[3] + n * pi};
            counts = counts || known->counts;
        }
    };
    add(*this, 1);
    add(other, -1);
    for (auto const& [symbol, power] : own)
        if (power != 0) return std::nullopt;
    for (std::size_t k = 0; k < dimension.size(); ++k) {
        bool const angle = k + 1 == dimension.size();
        if (dimension[k] != 0 && (!angle || counts)) return std::nullopt;
    }
    for (auto& n : size) {
        if (n % model_detail::whole_power != 0) return std::nullopt;
        n /= model_detail::whole_power;
    }
    return ratio{static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2]),
                 static_cast<int>(size[3])};
}

SIVID_DECL void unit::drop_zeros() {
    for (auto it = powers_.begin(); it != powers_.end();) {
        it = it->second == 0 ? powers_.erase(it) : std::next(it);
    }
}

SIVID_DECL std::string rate_unit(std::string_view quantity, std::string_view time) {
    unit const plain(quantity);
    if (plain.fault().empty()) return plain.times(unit(time), -1).text();
    return "(" + std::string(quantity) + ")/" + std::string(time);
}

} // namespace sivid

#endif

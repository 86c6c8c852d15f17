// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_IMPL_MISSING_TERM_IPP
#define SIVID_MODEL_IMPL_MISSING_TERM_IPP

#include <sivid/model/named_effects.hpp>

#include <sivid/compiled.hpp>
#include <sivid/model/expression.hpp>
#include <sivid/number/decimal.hpp>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sivid {

namespace detail {

/// Reads the formula of a term from left to right, without going back.
class term_reader {
public:
    using leaf = std::function<expression(std::string const&)>;

    /// What turn and wave bring: a, b, w, or nothing where these do not stand.
    struct unknowns {
        std::function<expression(std::size_t)> parameter;
        bool turns = false, waves = false; ///< what was read
    };

    term_reader(std::string const& name, std::size_t begin, leaf value, unknowns& own)
        : name_(&name), at_(begin), value_(std::move(value)), own_(&own) {}

    [[nodiscard]] expression read() {
        auto const result = product(true);
        if (at_ != name_->size()) fail("'*' or '/' is needed here");
        return result;
    }

private:
    static constexpr int most_nested = 8;

    [[noreturn]] void fail(std::string const& why) const {
        throw std::invalid_argument("term '" + *name_ + "', character " + std::to_string(at_ + 1) +
                                    ": " + why + "; write a term as in v'~0.5*abs(v)*v");
    }
    [[nodiscard]] char next() const { return at_ < name_->size() ? (*name_)[at_] : '\0'; }
    bool take(char c) {
        if (next() != c) return false;
        ++at_;
        return true;
    }
    void need(char c) {
        if (!take(c)) fail(std::string("'") + c + "' is needed here");
    }

    [[nodiscard]] expression sum() {
        if (++nested_ > most_nested) fail("too many brackets");
        auto result = take('-') ? -product(false) : product(false);
        for (;;) {
            if (take('+')) {
                result += product(false);
            } else if (take('-')) {
                result -= product(false);
            } else {
                --nested_;
                return result;
            }
        }
    }
    /// @param outside  of all brackets, where turn and wave may stand
    [[nodiscard]] expression product(bool outside) {
        auto result = power(outside);
        for (;;) {
            if (take('*')) {
                result *= power(outside);
            } else if (take('/')) {
                result /= power(false);
            } else {
                return result;
            }
        }
    }
    [[nodiscard]] expression power(bool outside) {
        auto result = factor(outside);
        if (!take('^')) return result;
        if (next() < '2' || next() > '9') fail("a power from 2 to 9 is needed here");
        int const n = (*name_)[at_++] - '0';
        return n == 2 ? sqr(result) : pown(result, n);
    }
    [[nodiscard]] bool is_digit(std::size_t k) const {
        return k < name_->size() && std::isdigit(static_cast<unsigned char>((*name_)[k])) != 0;
    }
    [[nodiscard]] expression number() {
        auto const begin = at_;
        while (is_digit(at_) || next() == '.') ++at_;
        if (next() == 'e') { // 4e+02; else it is the begin of a word
            bool const sign =
                at_ + 1 < name_->size() && ((*name_)[at_ + 1] == '+' || (*name_)[at_ + 1] == '-');
            auto const first = at_ + (sign ? 2 : 1);
            if (is_digit(first)) at_ = first;
            while (is_digit(at_)) ++at_;
        }
        auto const text = std::string_view(*name_).substr(begin, at_ - begin);
        auto const value = parse_decimal(text);
        if (!value) fail("'" + std::string(text) + "' is no number");
        return expression(*value);
    }
    [[nodiscard]] expression factor(bool outside) {
        if (is_digit(at_)) return number();
        auto const begin = at_;
        while (std::isalnum(static_cast<unsigned char>(next())) != 0 || next() == '_') ++at_;
        auto const word = name_->substr(begin, at_ - begin);
        bool const opens = take('(');
        if (word.empty() && !opens) fail("a factor is needed here");
        if (!opens) return value_(word);
        auto const x = sum();
        expression result;
        if (word.empty()) {
            result = x;
        } else if (word == "abs") {
            result = abs(x);
        } else if (word == "sqrt") {
            result = sqrt(x);
        } else if (word == "exp") {
            result = exp(x);
        } else if (word == "sgn") {
            need(':');
            result = x / sqrt(sqr(x) + sqr(number()));
        } else if (word == "beyond") {
            need(':');
            result = deadband(x, number());
        } else if (word == "turn" || word == "wave") {
            if (!outside || own_->turns || own_->waves) {
                fail("turn and wave stand once, outside of brackets");
            }
            own_->turns = true;
            own_->waves = word == "wave";
            auto const angle = own_->waves ? own_->parameter(2) * x : x;
            result = own_->parameter(0) * cos(angle) + own_->parameter(1) * sin(angle);
        } else {
            fail("'" + word +
                 "' is no function: there are abs, sqrt, exp, sgn, beyond, turn, wave");
        }
        need(')');
        return result;
    }

    std::string const* name_;
    std::size_t at_;
    int nested_ = 0;
    leaf value_;
    unknowns* own_;
};

} // namespace detail

SIVID_DECL effect missing_term(std::string const& name) {
    using namespace literals;
    auto const mark = name.find("'~");
    if (mark == std::string::npos || mark == 0) {
        throw std::invalid_argument("'" + name +
                                    "' names no term; write one as in v'~0.5*abs(v)*v");
    }
    auto const begin = mark + 2;
    // Once without a model: is it a formula, and what are its unknowns?
    detail::term_reader::unknowns own{[](std::size_t) { return expression(1); }};
    (void)detail::term_reader(
        name, begin, [](std::string const&) { return expression(1); }, own)
        .read();
    effect e;
    e.name = name;
    auto const state = name.substr(0, mark);
    e.about = "missing in " + state + "': " + name.substr(begin);
    if (own.turns) {
        e.parameters = {{"a", "1", -1_dec, 1_dec, 0_dec}, {"b", "1", -1_dec, 1_dec, 0_dec}};
        if (own.waves) e.parameters.push_back({"w", "1", 0.85_dec, 1.18_dec, 1_dec});
    } else {
        e.parameters = {{"k", "1", -1_dec, 1_dec, 0_dec}};
    }
    e.on_rates = [name, begin, state, alone = !own.turns](effect_scope& m) {
        detail::term_reader::unknowns unknown{[&m](std::size_t k) { return m.parameter(k); }};
        auto const term =
            detail::term_reader(
                name, begin, [&m](std::string const& x) { return m.named(x); }, unknown)
                .read();
        m.rate(state) += alone ? m.parameter() * term : term;
    };
    return e;
}

} // namespace sivid

#endif

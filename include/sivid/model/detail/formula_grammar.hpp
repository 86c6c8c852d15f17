// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_DETAIL_FORMULA_GRAMMAR_HPP
#define SIVID_MODEL_DETAIL_FORMULA_GRAMMAR_HPP

#include <sivid/model/detail/formula_words.hpp>
#include <sivid/model/graph/operation.hpp>

#include <array>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace sivid::model_detail {

/// The functions of one number, or of two and more (min, max), that formulas know by name.
[[nodiscard]] inline std::optional<operation> function_named(std::string_view name) {
    for (auto const op :
         {operation::sqr, operation::sqrt, operation::exp, operation::log, operation::sin,
          operation::cos, operation::tan, operation::atan, operation::tanh, operation::abs,
          operation::sign, operation::min, operation::max})
        if (sivid::name(op) == name) return op;
    return std::nullopt;
}

/// The grammar of all formulas: those of models, of terms that a model lacks, of requirements and
/// of control laws. Read from left to right, without going back:
///   sum      =  product { (+|-) product }
///   product  =  factor { (*|/) factor }
///   factor   =  (-|+) factor  |  primary [ ^ power ]
///   primary  =  number  |  name  |  name ( ... )  |  ( ... )
/// What the parts mean is Self's:
///   Value constant(std::string_view text, std::size_t position);
///   Value quantity_of(std::string const& name, std::size_t position);
///   Value call(std::string const& name, std::size_t position);   its bracket is open
///   Value in_brackets();                                          up to the bracket that closes
///   Value combined(operation, Value const&, Value const&, std::size_t sign);  + - * /, at `sign`
///   Value negated(Value const&, std::size_t position);
///   Value raised(Value const&, std::size_t hat);                  the power is still to be read
///   Value placed(Value, std::size_t position);                    stands in brackets from there on
template <class Self, class Value>
class formula_grammar {
protected:
    /// @param deepest  so deep may brackets and signs stand in each other
    formula_grammar(formula_words words, std::size_t deepest)
        : words_(std::move(words)), deepest_(deepest) {}
    ~formula_grammar() = default;

    /// One level of nesting.
    class level {
    public:
        explicit level(formula_grammar& g) : depth_(g.depth_) {
            if (++depth_ > g.deepest_) {
                --depth_;
                g.words_.fail("nested too deep", "use fewer brackets, at most " +
                                                     std::to_string(g.deepest_) + " deep");
            }
        }
        level(level const&) = delete;
        level& operator=(level const&) = delete;
        ~level() { --depth_; }

    private:
        std::size_t& depth_;
    };

    Value sum() {
        auto left = product();
        for (;;) {
            auto const sign = words_.position();
            if (words_.peek("+=") || words_.peek("-=")) return left; // of what follows
            if (words_.take("+"))
                left = self().combined(operation::add, left, product(), sign);
            else if (words_.take("-"))
                left = self().combined(operation::sub, left, product(), sign);
            else
                return left;
        }
    }
    Value product() {
        auto left = factor();
        for (;;) {
            auto const sign = words_.position();
            if (words_.peek("*=") || words_.peek("/=")) return left;
            if (words_.take("*"))
                left = self().combined(operation::mul, left, factor(), sign);
            else if (words_.take("/"))
                left = self().combined(operation::div, left, factor(), sign);
            else
                return left;
        }
    }
    Value factor() {
        level const nested(*this);
        auto const position = words_.position();
        if (words_.take("-")) return self().negated(factor(), position);
        if (words_.take("+")) return factor();
        auto base = primary();
        auto const hat = words_.position();
        if (!words_.take("^")) return base;
        return self().raised(base, hat);
    }
    Value primary() {
        auto const position = words_.position();
        if (auto const text = words_.take_number()) return self().constant(*text, position);
        if (words_.take("(")) {
            auto of = self().in_brackets();
            words_.need(")", "close the bracket");
            return self().placed(std::move(of), position);
        }
        auto const name = words_.take_name();
        if (!name)
            words_.fail(words_.at_end() ? "something is missing"
                                        : "this cannot begin an expression",
                        "write a number, a name of the model, a function, or a bracket");
        // On another line a bracket begins something else.
        if (words_.on_line_of(position) && words_.take("(")) return self().call(*name, position);
        return self().quantity_of(*name, position);
    }
    /// The whole number behind ^, from lowest to highest.
    /// @param hat  where that stands, for messages
    int whole_power(std::size_t hat, int lowest, int highest) {
        bool const negative = lowest < 0 && words_.take("-");
        auto const text = words_.take_number();
        int power = 0;
        bool whole = text.has_value();
        if (text) {
            auto const end = text->data() + text->size();
            auto const [stop, fault] = std::from_chars(text->data(), end, power);
            whole = fault == std::errc{} && stop == end;
        }
        if (negative) power = -power;
        if (!whole || power < lowest || power > highest)
            words_.fail_at(hat,
                           "a power needs a whole number from " + std::to_string(lowest) + " to " +
                               std::to_string(highest),
                           "write x^2; for others use exp and log");
        return power;
    }

    formula_words words_;

private:
    Self& self() { return static_cast<Self&>(*this); }

    std::size_t depth_ = 0, deepest_;
};

} // namespace sivid::model_detail

#endif

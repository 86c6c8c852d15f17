// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_CERTIFICATE_EQUATIONS_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_CERTIFICATE_EQUATIONS_HPP

#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>
#include <sivid/model/parameter_choice.hpp>
#include <sivid/number/decimal_output.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace sivid::io_detail {

/// Why a certificate cannot be made, and what to do.
[[noreturn]] inline void not_certifiable(std::string const& what) {
    throw std::invalid_argument("no certificate: " + what +
                                "; `check` proves such a result by sivid itself");
}
/// A field of a line: never empty, without tabs and line ends.
[[nodiscard]] inline std::string certificate_field(std::string text) {
    for (auto& c : text)
        if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
    return text.empty() ? "-" : text;
}

/// The equations of a model, one operation a line, as a certificate has them.
class certificate_equations {
public:
    certificate_equations(recorded_model const& model, parameter_choice const& choice)
        : model_(&model) {
        auto const& about = model.about;
        for (auto const& s : about.states) add_name(s.name);
        for (auto const& u : about.inputs) add_name(u.name);
        for (auto const& c : about.constants) add_name(c.name);
        auto const in_force = followed(model, choice);
        std::vector<node_id> roots = model.rate;
        roots.insert(roots.end(), model.observe.begin(), model.observe.end());
        std::set<std::size_t> follows;
        for (auto const& d : in_force) {
            roots.push_back(d.value);
            follows.insert(d.constant);
        }
        for (auto const k : leaves_of(model.g, roots, operation::constant))
            if (!follows.contains(k)) add_constant(about.constants[k], choice);
        for (auto const& d : in_force)
            text_ += "let\t" + about.constants[d.constant].name + "\t=\t" + value(d.value) + "\n";
        for (std::size_t i = 0; i < model.rate.size(); ++i) {
            auto const of = value(model.rate[i]);
            text_ += "rate\t" + about.states[i].name + "\t=\t" + of + "\n";
        }
        for (std::size_t y = 0; y < model.observe.size(); ++y) {
            auto const of = value(model.observe[y]);
            text_ += "output\t" + certificate_field(about.channels[y].name) + "\t" +
                     certificate_field(about.channels[y].unit) + "\t=\t" + of + "\n";
        }
    }
    [[nodiscard]] std::string const& text() const { return text_; }

private:
    static constexpr std::size_t most_lines = 200; ///< the checker's memory is fixed

    void add_name(std::string const& name) {
        bool const plain = !name.empty() && certificate_field(name) == name &&
                           std::string("0123456789.-%").find(name[0]) == std::string::npos;
        if (!plain || name == "t" || !names_.insert(name).second)
            not_certifiable("the name '" + name +
                            "' of a state, input or constant stands twice "
                            "or cannot be written");
    }
    void add_constant(model_description::constant const& c, parameter_choice const& choice) {
        auto const& unknown = choice.unknown;
        if (std::find(unknown.begin(), unknown.end(), c.name) != unknown.end()) return;
        auto const fixed = choice.fixed.find(c.name);
        auto const x = fixed == choice.fixed.end() ? c.nominal.enclosure : fixed->second;
        double const nearest = fixed == choice.fixed.end() ? c.nominal.nearest : mid(x);
        text_ += "constant\t" + c.name + "\t" + certificate_field(c.unit) + "\t" +
                 (is_decimal(x, nearest) ? nearest_text(nearest) : ends(x)) + "\n";
    }
    /// Whether the checker's enclosure of the decimal, a double to both sides, holds all of it.
    [[nodiscard]] static bool is_decimal(interval const& x, double nearest) {
        return std::nextafter(nearest, -HUGE_VAL) <= x.lower() &&
               x.upper() <= std::nextafter(nearest, HUGE_VAL);
    }
    [[nodiscard]] static std::string ends(interval const& x) {
        return to_decimal_lower(x.lower()) + "\t" + to_decimal_upper(x.upper());
    }

    /// The name of a node, after the lines that it needs.
    std::string value(node_id root) {
        auto const needed = operands_of(model_->g, {root});
        for (std::size_t k = 0; k < needed.size(); ++k) {
            auto const i = static_cast<node_id>(k);
            if (needed[k] && !named_.contains(i)) named_.emplace(i, leaf_or_line(i));
        }
        return named_.at(root);
    }
    std::string line(std::string const& operation) {
        auto const name = "%" + std::to_string(++count_);
        if (count_ > most_lines) not_certifiable("the equations are too long for the checker");
        text_ += "let\t" + name + "\t=\t" + operation + "\n";
        return name;
    }
    std::string leaf_or_line(node_id i) {
        auto const& n = model_->g[i];
        auto const k = static_cast<std::size_t>(n.index);
        switch (n.op) {
        case operation::literal:
            return literal_text(model_->g.value(n));
        case operation::time:
            return "t";
        case operation::state:
            return model_->about.states[k].name;
        case operation::constant:
            return model_->about.constants[k].name;
        case operation::input:
            return model_->about.inputs[k].name;
        default:
            return operation_line(n);
        }
    }
    std::string literal_text(literal const& l) {
        if (is_decimal(l.enclosure, l.nearest)) return nearest_text(l.nearest);
        auto const name = "%" + std::to_string(++count_);
        text_ += "constant\t" + name + "\t-\t" + ends(l.enclosure) + "\n";
        return name;
    }
    std::string operation_line(node const& n) {
        auto const& a = named_.at(n.a);
        auto const with = [&](char const* sign) {
            return line(a + "\t" + sign + "\t" + named_.at(n.b));
        };
        switch (n.op) {
        case operation::neg:
            return line("-\t" + a);
        case operation::add:
            return with("+");
        case operation::sub:
            return with("-");
        case operation::mul:
            return with("*");
        case operation::div:
            return with("/");
        case operation::pown:
            return power(a, n.index);
        case operation::tan:
            return quotient(line("sin\t" + a), line("cos\t" + a));
        case operation::tanh: // 1 - 2/(exp(2 a) + 1)
            return line("1\t-\t" +
                        quotient("2", line(line("exp\t" + line(a + "\t+\t" + a)) + "\t+\t1")));
        case operation::sqr:
        case operation::sqrt:
        case operation::exp:
        case operation::sin:
        case operation::cos:
            return line(std::string(name(n.op)) + "\t" + a);
        default:
            not_certifiable("the equations have '" + std::string(name(n.op)) +
                            "', which the checker does not know");
        }
    }
    std::string quotient(std::string const& a, std::string const& b) {
        return line(a + "\t/\t" + b);
    }
    std::string power(std::string const& a, int n) {
        if (n == 1) return a;
        auto const square = line("sqr\t" + power(a, n / 2));
        return n % 2 == 0 ? square : line(square + "\t*\t" + a);
    }

    recorded_model const* model_;
    std::string text_;
    std::set<std::string> names_;
    std::map<node_id, std::string> named_;
    std::size_t count_ = 0;
};

} // namespace sivid::io_detail

#endif

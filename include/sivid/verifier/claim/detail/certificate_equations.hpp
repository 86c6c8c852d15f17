// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_CERTIFICATE_EQUATIONS_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_CERTIFICATE_EQUATIONS_HPP

#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>
#include <sivid/model/parameter_choice.hpp>
#include <sivid/number/decimal_output.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace sivid::io_detail {

/// Says why there is no certificate. @throws std::invalid_argument
[[noreturn]] inline void not_certifiable(std::string const& why) {
    throw std::invalid_argument("no certificate: " + why +
                                "; `check` proves such a result by sivid itself");
}
/// A field of a line: never empty, without tabs and line ends.
[[nodiscard]] inline std::string certificate_field(std::string text) {
    for (auto& c : text)
        if (static_cast<unsigned char>(c) < 32 || c == 127) c = ' ';
    return text.empty() ? "-" : text;
}

/// The equations of a model as a certificate has them: one operation a line.
class certificate_equations {
public:
    /// @param units  of the channels, each with the factor of its numbers
    certificate_equations(recorded_model const& m, parameter_choice const& choice,
                          std::vector<std::string> const& units)
        : g_(&m.g) {
        auto const& about = m.about;
        for (auto const& s : about.states) states_.push_back(own_name(s.name));
        for (auto const& u : about.inputs) inputs_.push_back(own_name(u.name));
        for (auto const& c : about.constants) constants_.push_back(own_name(c.name));
        auto roots = m.rate;
        roots.insert(roots.end(), m.observe.begin(), m.observe.end());
        std::set<std::size_t> others; // unknown, or functions of constants
        for (auto const& p : choice.unknown)
            others.insert(index_of(about.constants, p, "constant"));
        for (auto const& d : followed(m, choice)) {
            roots.push_back(d.value);
            others.insert(d.constant);
        }
        for (auto const k : leaves_of(m.g, roots, operation::constant)) {
            auto const& c = about.constants[k];
            auto const own = choice.fixed.find(c.name);
            auto const known =
                own == choice.fixed.end() ? c.nominal : literal{own->second, mid(own->second)};
            if (others.contains(k)) continue;
            text_ += "constant\t" + c.name + "\t" + certificate_field(c.unit) + "\t" +
                     number(known) + "\n";
        }
        for (auto const& d : followed(m, choice)) define("let\t" + constants_[d.constant], d.value);
        for (std::size_t i = 0; i < states_.size(); ++i) define("rate\t" + states_[i], m.rate[i]);
        for (std::size_t y = 0; y < m.observe.size(); ++y)
            define("output\t" + certificate_field(about.channels[y].name) + "\t" + units.at(y),
                   m.observe[y]);
    }
    [[nodiscard]] std::string const& text() const { return text_; }

private:
    static constexpr std::size_t most_lines = 200; ///< the checker's memory is fixed

    std::string const& own_name(std::string const& name) {
        bool const plain = !name.empty() && certificate_field(name) == name && name != "t" &&
                           std::string("0123456789.-%").find(name[0]) == std::string::npos;
        if (!plain || !names_.insert(name).second)
            not_certifiable("the name '" + name + "' stands twice or cannot be written");
        return name;
    }
    /// A decimal where the checker's enclosure of it, a double to both sides, holds all that may be
    /// meant; else two.
    [[nodiscard]] static std::string number(literal const& l) {
        auto const& x = l.enclosure;
        if (std::nextafter(l.nearest, -HUGE_VAL) <= x.lower() &&
            x.upper() <= std::nextafter(l.nearest, HUGE_VAL))
            return nearest_text(l.nearest);
        return to_decimal_lower(x.lower()) + "\t" + to_decimal_upper(x.upper());
    }
    void define(std::string const& what, node_id root) {
        auto const needed = operands_of(*g_, {root});
        for (std::size_t k = 0; k < needed.size(); ++k) {
            auto const i = static_cast<node_id>(k);
            if (needed[k] && !named_.contains(i)) named_[i] = name_of((*g_)[i]);
        }
        text_ += what + "\t=\t" + named_[root] + "\n";
    }
    /// The name of a new line.
    std::string line(std::string const& operation, std::string const& kind = "let\t%",
                     std::string const& behind = "\t=\t") {
        if (++count_ > most_lines) not_certifiable("the equations are too long for the checker");
        text_ += kind + std::to_string(count_) + behind + operation + "\n";
        return "%" + std::to_string(count_);
    }
    [[nodiscard]] std::string known(node_id i) const {
        auto const found = named_.find(i);
        return found == named_.end() ? std::string{} : found->second;
    }
    std::string name_of(node const& n) {
        auto const k = static_cast<std::size_t>(n.index);
        auto const a = known(n.a), b = known(n.b);
        switch (n.op) {
        case operation::literal: {
            auto const text = number(g_->value(n));
            bool const one = text.find('\t') == std::string::npos;
            return one ? text : line(text, "constant\t%", "\t-\t");
        }
        case operation::time:
            return "t";
        case operation::state:
            return states_[k];
        case operation::constant:
            return constants_[k];
        case operation::input:
            return inputs_[k];
        case operation::neg:
            return line("-\t" + a);
        case operation::pown:
            return power(a, n.index);
        case operation::tan:
            return line(line("sin\t" + a) + "\t/\t" + line("cos\t" + a));
        case operation::tanh: // 1 - 2/(exp(2 a) + 1)
            return line("1\t-\t" +
                        line("2\t/\t" + line(line("exp\t" + line(a + "\t+\t" + a)) + "\t+\t1")));
        default:
            return usual(n.op, a, b);
        }
    }
    std::string usual(operation op, std::string const& a, std::string const& b) {
        static std::map<operation, std::string> const signs{{operation::add, "\t+\t"},
                                                            {operation::sub, "\t-\t"},
                                                            {operation::mul, "\t*\t"},
                                                            {operation::div, "\t/\t"}};
        static std::set const functions{operation::sqr, operation::sqrt, operation::exp,
                                        operation::sin, operation::cos};
        if (auto const sign = signs.find(op); sign != signs.end())
            return line(a + sign->second + b);
        if (functions.contains(op)) return line(std::string(name(op)) + "\t" + a);
        not_certifiable("the equations have '" + std::string(name(op)) +
                        "', which the checker does not know");
    }
    std::string power(std::string const& a, int n) {
        if (n == 1) return a;
        auto const square = line("sqr\t" + power(a, n / 2));
        return n % 2 == 0 ? square : line(square + "\t*\t" + a);
    }

    graph const* g_;
    std::string text_;
    std::vector<std::string> states_, inputs_, constants_;
    std::set<std::string> names_;
    std::map<node_id, std::string> named_;
    std::size_t count_ = 0;
};

} // namespace sivid::io_detail

#endif

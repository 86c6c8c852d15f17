// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_PROBLEM_TEXT_HPP
#define SIVID_MODEL_PROBLEM_TEXT_HPP

#include <sivid/model/problem.hpp>

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

namespace sivid {

namespace model_detail {

/// Bytes in which different values are written differently, doubles by their bits. Zero has no
/// sign: which one a bound gets depends on how the compiler adds.
class canonical_text {
public:
    template <class... Values>
    canonical_text& operator()(std::string_view name, Values const&... values) {
        text_.append(name);
        (put(values), ...);
        text_ += '\n';
        return *this;
    }
    [[nodiscard]] std::string const& text() const { return text_; }

private:
    void put(std::string const& s) {
        text_ += ' ';
        text_ += std::to_string(s.size()) + ':';
        text_ += s;
    }
    void put(double x) {
        auto bits = std::bit_cast<std::uint64_t>(x == 0 ? 0.0 : x);
        std::array<char, 9> bytes{' '};
        for (std::size_t k = 1; k < bytes.size(); ++k, bits >>= 8) {
            bytes[k] = static_cast<char>(bits & 0xff);
        }
        text_.append(bytes.data(), bytes.size());
    }
    template <class T>
        requires std::integral<T> || std::is_enum_v<T>
    void put(T x) {
        text_ += ' ';
        text_ += std::to_string(static_cast<long long>(x));
    }
    void put(interval const& x) {
        put(x.lower());
        put(x.upper());
    }
    template <class Items>
        requires requires(Items const& items) {
            items.begin();
            items.size();
        }
    void put(Items const& items) {
        put(items.size());
        for (auto const& i : items) put(i);
    }

    std::string text_;
};

inline void describe(canonical_text& t, graph const& g) {
    for (auto const& n : g.nodes()) {
        t("node", n.op, n.a, n.b, n.companion, n.index);
        if (n.op == operation::literal) t("literal", g.value(n).enclosure, g.value(n).nearest);
    }
}

inline void describe(canonical_text& t, recorded_model const& m) {
    t("model", m.about.name, m.about.time_unit);
    for (auto const& s : m.about.states) {
        t("state", s.name, s.unit, s.limit.upper);
        if (s.limit.lower != -s.limit.upper) t("from", s.limit.lower);
    }
    for (auto const& i : m.about.inputs) t("input", i.name, i.unit);
    for (auto const& c : m.about.channels) t("channel", c.name, c.unit);
    for (auto const& c : m.about.constants) {
        t("constant", c.name, c.unit, c.nominal.enclosure, c.nominal.nearest);
    }
    describe(t, m.g);
    t("rate", m.rate)("observe", m.observe);
    auto const remembered = [&t](char const* what, signal_memory const& d) {
        t(what, d.index, d.constant);
        if (d.only_if) t("only if", *d.only_if);
    };
    for (auto const& d : m.input_memory)
        remembered(d.kind == memory_kind::play         ? "input play"
                   : d.kind == memory_kind::rate_limit ? "input rate limit"
                   : d.kind == memory_kind::drift      ? "input drift"
                                                       : "input delay",
                   d);
    for (auto const& d : m.channel_delays)
        remembered(d.kind == memory_kind::drift ? "channel drift" : "channel delay", d);
    for (auto const& c : m.input_copies) t("input copy", c.copy, c.of);
    for (auto const& s : m.added_states) t("added state", s.state, s.at_begin);
    for (auto const& d : m.derived) t("derived constant", d.constant, d.value, d.always);
}

inline void describe(canonical_text& t, identification_problem const& p) {
    describe(t, p.model);
    t("unknown", p.choice.unknown)("prior", p.prior);
    for (auto const& [name, value] : p.choice.fixed) t("fixed", name, value);
    for (auto const& e : p.experiments) {
        t("experiment", e.name, e.begin, e.initial, e.outliers);
        if (e.constraint) t("constraint");
        for (auto const& b : e.bridged) t("bridged", b.input, b.samples, b.longest, b.held);
        for (auto const& m : e.measurements) t("measured", m.time, m.channel, m.bound);
        for (auto const& input : e.inputs) {
            if (auto const* sampled = std::get_if<sampled_signal>(&input)) {
                t("sampled", sampled->kind(), sampled->times(), sampled->values());
                if (!sampled->exact()) t("errors", sampled->errors());
            } else if (auto const* formula = std::get_if<analytic_signal>(&input)) {
                describe(t("formula", formula->value), formula->g);
            }
        }
    }
}

} // namespace model_detail

/// All that is asked in a problem, as bytes to be digested: equal bytes are equal problems.
/// @cost  linear in the problem
[[nodiscard]] inline std::string problem_text(identification_problem const& problem) {
    model_detail::canonical_text text;
    describe(text, problem);
    return text.text();
}

} // namespace sivid

#endif // SIVID_MODEL_PROBLEM_TEXT_HPP

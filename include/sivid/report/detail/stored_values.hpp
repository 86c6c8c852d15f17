// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_DETAIL_STORED_VALUES_HPP
#define SIVID_REPORT_DETAIL_STORED_VALUES_HPP

#include <sivid/decision/experiment_design.hpp>
#include <sivid/decision/gain_search.hpp>
#include <sivid/decision/measurement_ranking.hpp>
#include <sivid/decision/prediction.hpp>
#include <sivid/decision/rank.hpp>
#include <sivid/decision/requirement.hpp>
#include <sivid/decision/verification.hpp>
#include <sivid/io/result/stored_prediction.hpp>
#include <sivid/io/text/json_document.hpp>
#include <sivid/io/text/json_writer.hpp>
#include <sivid/measurement/signal.hpp>
#include <sivid/number/text/sha256.hpp>
#include <sivid/paving/subpaving.hpp>
#include <sivid/report/diagnosis_view.hpp>
#include <sivid/report/identification_view.hpp>
#include <sivid/report/page.hpp>
#include <sivid/space/box.hpp>

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace sivid::report {
struct simulated_line; // of decision_page.hpp, which stores its pages by this file
struct decision_page_options;
} // namespace sivid::report

/// Values of any depth as lists in JSON, and back to the last bit.
namespace sivid::report::detail {

template <class T, class... Ts>
inline constexpr bool one_of = (std::same_as<T, Ts> || ...);

/// How many members a type has whose values stand one after the other; 0: it is no such type. A
/// wrong number does not compile.
template <class T>
inline constexpr std::size_t fields_of =
    one_of<T, range, point, plane_box, named_witness, named_witness::start, tried_candidates::count,
           changed_formulas, named_combination::part, withdrawn_claim, decisive_place, design_goal,
           planned_measurements, model_description::item, state_range, literal, paved_box>
        ? 2
    : one_of<T, axis, tube_piece, pose, projected_box, diagnosis_plot_data, compared_scenario,
             missing_rate, time_window, error_correlation, reading_steps, tried_candidates,
             constant_at_end, promised_width, channel_effects, dependence_structure>
        ? 3
    : one_of<T, measured_sample, paving_projection, run_reach::cause, named_combination,
             next_experiment, unexplained_remainder, simulated_line, violating_motion,
             experiment_design, manoeuvre_setting, exact_measurements, combination,
             measurement_worth, measurement_group, model_description::state,
             model_description::constant>
        ? 4
    : one_of<T, combination_view, scenario_view, statistics_view, named_estimate, predicted_tube,
             open_box, varied_input, bridged_input>
        ? 5
    : one_of<T, parameter_view, broken_relation_report, noise_growth, promise, model_description>
        ? 6
    : one_of<T, plane_series, contraction_record, truth, tried_manoeuvre, ranking,
             measurement_ranking, needed_disturbance>
        ? 7
    : one_of<T, comparison_row, diagnosis_report_options, confined_gap> ? 8
    : one_of<T, decision_page_options, verification, parameter_effect>  ? 9
    : one_of<T, prediction>                                             ? 10
    : one_of<T, suspected_place, holdout_figures>                       ? 11
    : one_of<T, design_answer>                                          ? 12
    : one_of<T, cause>                                                  ? 13
    : one_of<T, channel_series>                                         ? 14
    : one_of<T, run_reach>                                              ? 15
    : one_of<T, identification_view>                                    ? 27
    : one_of<T, diagnosis>                                              ? 32
                                                                        : 0;

// clang-format off
/// Calls f with all members.
template <std::size_t N>
void with_fields(auto& x, auto const& f) {
    if constexpr (N == 2) { auto& [a, b] = x; f(a, b); }
    else if constexpr (N == 3) { auto& [a, b, c] = x; f(a, b, c); }
    else if constexpr (N == 4) { auto& [a, b, c, d] = x; f(a, b, c, d); }
    else if constexpr (N == 5) { auto& [a, b, c, d, e] = x; f(a, b, c, d, e); }
    else if constexpr (N == 6) { auto& [a, b, c, d, e, f_] = x; f(a, b, c, d, e, f_); }
    else if constexpr (N == 7) { auto& [a, b, c, d, e, f_, g] = x; f(a, b, c, d, e, f_, g); }
    else if constexpr (N == 8) { auto& [a, b, c, d, e, f_, g, h] = x; f(a, b, c, d, e, f_, g, h); }
    else if constexpr (N == 9) { auto& [a, b, c, d, e, f_, g, h, i] = x; f(a, b, c, d, e, f_, g, h, i); }
    else if constexpr (N == 10) { auto& [a, b, c, d, e, f_, g, h, i, j] = x; f(a, b, c, d, e, f_, g, h, i, j); }
    else if constexpr (N == 11) { auto& [a, b, c, d, e, f_, g, h, i, j, k] = x; f(a, b, c, d, e, f_, g, h, i, j, k); }
    else if constexpr (N == 12) {
        auto& [a, b, c, d, e, f_, g, h, i, j, k, l] = x; f(a, b, c, d, e, f_, g, h, i, j, k, l);
    }
    else if constexpr (N == 13) {
        auto& [a, b, c, d, e, f_, g, h, i, j, k, l, m] = x; f(a, b, c, d, e, f_, g, h, i, j, k, l, m);
    }
    else if constexpr (N == 14) {
        auto& [a, b, c, d, e, f_, g, h, i, j, k, l, m, n] = x; f(a, b, c, d, e, f_, g, h, i, j, k, l, m, n);
    }
    else if constexpr (N == 15) {
        auto& [a, b, c, d, e, f_, g, h, i, j, k, l, m, n, o] = x; f(a, b, c, d, e, f_, g, h, i, j, k, l, m, n, o);
    }
    else if constexpr (N == 27) {
        auto& [a, b, c, d, e, f_, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x_, y, z, aa] = x;
        f(a, b, c, d, e, f_, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x_, y, z, aa);
    }
    else if constexpr (N == 32) {
        auto& [a, b, c, d, e, f_, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x_, y, z, aa, ab, ac,
          ad, ae, af] = x;
        f(a, b, c, d, e, f_, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x_, y, z, aa, ab, ac, ad,
          ae, af);
    }
    else static_assert(N == 0, "with_fields: add this number of members");
}
// clang-format on

/// Doubles that are no decimals of JSON.
inline constexpr std::array<std::pair<std::string_view, double>, 4> special_doubles{
    {{"inf", std::numeric_limits<double>::infinity()},
     {"-inf", -std::numeric_limits<double>::infinity()},
     {"nan", std::numeric_limits<double>::quiet_NaN()},
     {"-0", -0.0}}};

template <class T>
concept whole_number = std::integral<T> && !std::same_as<T, bool>;

template <class X, class T>
concept either = std::same_as<std::remove_const_t<X>, T>;

// Of these a page shows some members alone.

void with_shown(either<stored_prediction> auto& x, auto const& f) {
    auto& p = x.problem;
    f(p.model.about, p.sets, p.inputs, p.initial, p.end, x.direct.model.about,
      x.direct.choice.unknown, x.direct.initial, x.sides, x.in_products, x.not_in_products,
      x.assumptions, x.feasible_with);
}
void with_shown(either<identification_problem> auto& x, auto const& f) {
    f(x.model.about, x.choice.unknown, x.prior, x.experiments);
}
void with_shown(either<experiment> auto& x, auto const& f) { f(x.name, x.inputs, x.bridged); }
void with_shown(either<requirement> auto& x, auto const& f) { f(x.text, x.labels); }
void with_shown(either<gain_set> auto& x, auto const& f) {
    f(x.names, x.paving.paving, x.paving.reason, x.against, x.suggested, x.found, x.tolerance,
      x.unknown, x.parts, x.integrations, x.seconds);
}
void with_shown(either<diagnosis_view> auto& x, auto const& f) {
    f(static_cast<std::conditional_t<std::is_const_v<std::remove_reference_t<decltype(x)>>,
                                     diagnosis const&, diagnosis&>>(x),
      x.about, x.plots, x.why);
}
template <class T>
concept shown_in_part = requires(T const& x) {
    with_shown(x, [](auto const&...) {});
};

class value_writer {
public:
    template <class... T>
    void list(T const&... all) {
        json_.begin_array(json_writer::layout::one_line);
        (put(all), ...);
        json_.end_array();
    }
    [[nodiscard]] std::string text() const { return json_.text(); }

    template <class T>
    void put(T const& x) {
        if constexpr (fields_of < T >> 0)
            with_fields<fields_of<T>>(x, [this](auto const&... all) { this->list(all...); });
        else if constexpr (std::is_enum_v<T>)
            json_.value(static_cast<int>(x));
        else
            json_.value(x);
    }
    void put(double x) {
        for (auto const& [name, special] : special_doubles)
            if ((std::isnan(x) && std::isnan(special)) ||
                (x == special && std::signbit(x) == std::signbit(special))) {
                json_.value(name);
                return;
            }
        json_.value(x);
    }
    void put(interval const& x) { list(x.lower(), x.upper()); }
    void put(box const& x) { put(std::vector<interval>(x.begin(), x.end())); }
    template <class T>
    void put(std::optional<T> const& x) {
        x ? list(*x) : list();
    }
    template <class A, class B>
    void put(std::pair<A, B> const& x) {
        list(x.first, x.second);
    }
    template <class T>
    void put(std::vector<T> const& all) {
        json_.begin_array(json_writer::layout::one_line);
        for (auto const& x : all) put(static_cast<T const&>(x));
        json_.end_array();
    }
    template <class A, class B>
    void put(std::map<A, B> const& all) {
        put(std::vector<std::pair<A, B>>(all.begin(), all.end()));
    }
    void put(signal const& u) { // of a formula nothing is shown
        auto const* s = std::get_if<sampled_signal>(&u);
        s != nullptr ? list(s->times(), s->values(), s->kind(), s->errors()) : list();
    }
    void put(subpaving const& p) { list(p.prior(), p.boxes(), p.inner_volume(), p.outer_volume()); }
    template <shown_in_part T>
    void put(T const& x) {
        with_shown(x, [this](auto const&... all) { this->list(all...); });
    }

private:
    json_writer json_;
};

class value_reader {
public:
    explicit value_reader(json_value const& json) : json_(&json) {}

    template <class... T>
    void list(T&... all) const {
        auto const& elements = json_->elements();
        if (elements.size() != sizeof...(all))
            json_->fail("a list of " + std::to_string(sizeof...(all)) + " values is needed",
                        "make the page by the version that wrote it");
        std::size_t k = 0;
        (value_reader(elements[k++]).get(all), ...);
    }

    template <class T>
    void get(T& x) const {
        if constexpr (fields_of < T >> 0) {
            with_fields<fields_of<T>>(x, [this](auto&... all) { this->list(all...); });
        } else if constexpr (std::is_enum_v<T>) {
            int number = 0;
            get(number);
            x = static_cast<T>(number);
        } else if constexpr (std::same_as<T, std::string>) {
            x = json_->raw_string();
        } else if constexpr (std::same_as<T, bool>) {
            x = json_->boolean();
        } else {
            static_assert(whole_number<T>);
            auto const value = number();
            if (!(value >= static_cast<double>(std::numeric_limits<T>::min()) && value <= 0x1p53) ||
                value != std::floor(value))
                json_->fail("a whole number is needed", "take the file as it was written");
            x = static_cast<T>(value);
        }
    }
    void get(double& x) const {
        if (json_->type() == json_value::kind::string) {
            for (auto const& [name, special] : special_doubles)
                if (json_->raw_string() == name) {
                    x = special;
                    return;
                }
        }
        x = number();
    }
    void get(interval& x) const {
        double low = 0, high = 0;
        list(low, high);
        x = std::isnan(low) || std::isnan(high) ? interval_traits<interval>::empty()
                                                : interval_traits<interval>::bounds(low, high);
    }
    void get(box& x) const {
        std::vector<interval> sides;
        get(sides);
        x = box(std::move(sides));
    }
    template <class T>
    void get(std::optional<T>& x) const {
        x.reset();
        if (json_->elements().empty()) return;
        T value{};
        list(value);
        x = std::move(value);
    }
    template <class A, class B>
    void get(std::pair<A, B>& x) const {
        list(x.first, x.second);
    }
    template <class T>
    void get(std::vector<T>& all) const {
        all.clear();
        for (auto const& element : json_->elements()) {
            T x{};
            value_reader(element).get(x);
            all.push_back(std::move(x));
        }
    }
    template <class A, class B>
    void get(std::map<A, B>& all) const {
        std::vector<std::pair<A, B>> pairs;
        get(pairs);
        all = {pairs.begin(), pairs.end()};
    }
    void get(signal& u) const {
        u = analytic_signal::from([](auto const&) { return 0.0; });
        if (json_->elements().empty()) return;
        std::vector<double> times, values, errors;
        interpolation kind{};
        list(times, values, kind, errors);
        u = sampled_signal(std::move(times), std::move(values), kind, std::move(errors));
    }
    void get(subpaving& p) const {
        box prior;
        std::vector<paved_box> boxes;
        interval inner, outer;
        list(prior, boxes, inner, outer);
        p = subpaving(std::move(prior));
        for (auto& b : boxes) p.add(std::move(b.set), b.verdict);
        p.set_volumes(inner, outer);
    }

    template <shown_in_part T>
    void get(T& x) const {
        with_shown(x, [this](auto&... all) { this->list(all...); });
    }

private:
    [[nodiscard]] double number() const { return nearest(json_->number()).value_or(0); }

    json_value const* json_;
};

inline constexpr std::string_view before_shown = "\"shows\": ";

/// A page of a kind, and what it shows with a digest: its writer alone knows what fits together.
template <class... Shown>
stored_page stored_as(std::string const& kind, std::string const& name, page const& made,
                      Shown const&... all) {
    value_writer out;
    out.list(all...);
    auto const shown = out.text();
    return {name + ".html", made.str(),
            "{\n  \"format\": \"sivid-page-1\",\n  \"page\": \"" + kind + "\",\n  \"sha256\": \"" +
                sha256(kind + "\n" + shown) + "\",\n  " + std::string{before_shown} + shown +
                "}\n"};
}

} // namespace sivid::report::detail

#endif

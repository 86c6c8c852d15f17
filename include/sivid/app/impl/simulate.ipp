// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPL_SIMULATE_IPP
#define SIVID_APP_IMPL_SIMULATE_IPP

#include <sivid/app/commands.hpp>

#include <sivid/app/console.hpp>
#include <sivid/app/detail/joined_effects.hpp>
#include <sivid/app/generate.hpp>
#include <sivid/app/names.hpp>
#include <sivid/app/program.hpp>
#include <sivid/approximate/simulate/simulate.hpp>
#include <sivid/decision/prediction.hpp>
#include <sivid/enclosure/enclosed_motion.hpp>
#include <sivid/enclosure/set/parametric_set.hpp>
#include <sivid/io/dataset_writer.hpp>
#include <sivid/io/file_set.hpp>
#include <sivid/io/text/json_writer.hpp>
#include <sivid/measurement/signal.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/describe.hpp>
#include <sivid/model/to_dot.hpp>
#include <sivid/number/decimal_output.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/report/draw/paving_plot.hpp>
#include <sivid/report/draw/time_plot.hpp>
#include <sivid/report/page.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sivid::app {

SIVID_DECL int run(robot const& r, describe_command const& c) {
    if (c.unknown.empty()) {
        result_stream() << (c.dot ? to_dot(r.model) : describe(r.model));
        for (std::size_t k = 0; !c.dot && k < r.effects.size(); ++k) {
            auto const& e = r.effects[k];
            result_stream() << "effect " << e.name << (e.about.empty() ? "" : ": ") << e.about
                            << "\n";
        }
        if (!c.dot && !r.disturbances.empty())
            result_stream() << "allowed for: " << in_words(r.disturbances, r.model) << "\n";
        return done;
    }
    for (auto const& name : c.unknown)
        require_known(name, names_in(r.model.about.constants), "constant");
    // Sampled inputs stay inputs, whatever their values.
    sampled_signal const samples({0, 1}, {0, 0}, interpolation::linear);
    auto const bound =
        bind(r.model, {c.unknown, {}}, std::vector<signal>(r.model.about.inputs.size(), samples));
    result_stream() << (c.dot ? to_dot(bound) : describe(bound));
    return done;
}

namespace detail {

inline std::string shortest(double x) { return exact_decimal::shortest(x).text(); }

/// One scenario, simulated and, on request, enclosed.
class simulated_scenario {
public:
    /// @param model  that of the robot, with the effects that act
    simulated_scenario(robot const& r, recorded_model const& model, scenario_description const& s,
                       simulate_command const& c)
        : about_{model.about}, plane_{r.plane}, scenario_{s} {
        auto const constants = middle_of(c);
        auto const recorded = c.input_rate
                                  ? record_inputs(s, *c.input_rate, 6, interpolation::linear)
                                  : std::vector<dataset_input>{};
        std::vector<signal> inputs;
        for (std::size_t i = 0; i < s.inputs.size(); ++i) {
            inputs.push_back(c.input_rate ? signal{recorded[i].signal}
                                          : exact_signal(s.inputs[i], s.duration));
        }
        inputs_ = inputs;
        box stated(s.initial.size());
        for (std::size_t i = 0; i < s.initial.size(); ++i) stated[i] = s.initial[i].enclosure;
        auto const start_for = [&](parameter_choice const& choice) {
            return start_with_added(model, constant_ranges(model, choice, {}), inputs, 0, stated);
        };
        auto const start = start_for({{}, c.set});
        auto const middle = mid(start_for(constants));
        auto times = sample_times(s.duration, c.rate, 6, true);
        if (times.back() < s.duration) times.push_back(s.duration);
        line_ = simulate(std::make_shared<approximate_model const>(model, constants, inputs),
                         inputs, middle, {}, 0, times, {1e-10});
        if (!c.validated) return;
        if (model.has_memory())
            throw bad_request("--validated: tubes of a model with delays, plays or rate limits are "
                              "not proved yet; without it the model is simulated");
        validated_ = true;
        if (!ranges_of(c).empty()) {
            enclose_ranges(model, c, inputs, start);
            return;
        }
        enclosure_options options;
        // A tube that needs shorter steps than a share of the duration gets no further.
        options.maximum_step = s.duration / 300;
        options.minimum_step = 1e-5;
        options.method = method_of(c.how);
        auto const followed = std::make_shared<flow const>(model, constants, inputs);
        auto const tube = enclosed(c.how, followed, start, s.duration, options);
        spans_ = tube.spans();
        if (tube.complete()) {
            at_end_ = tube.at(tube.end_time());
            return;
        }
        auto const& why = *tube.failure();
        failure_ = why.message(about_.states[why.component].name, about_.time_unit);
    }

    [[nodiscard]] std::string trajectory_csv() const {
        std::string text = "t";
        for (auto const& i : about_.inputs) text += std::string{","} + i.name;
        for (auto const& c : about_.channels) text += std::string{","} + c.name;
        text += "\n";
        for (std::size_t k = 0; k < line_.times.size(); ++k) {
            text += shortest(line_.times[k]);
            for (std::size_t i = 0; i < inputs_.size(); ++i)
                text += std::string{","} + shortest(input(i, line_.times[k]));
            for (double const y : line_.outputs[k]) text += std::string{","} + shortest(y);
            text += "\n";
        }
        return text;
    }

    [[nodiscard]] bool validated() const { return validated_; }
    [[nodiscard]] bool complete() const { return !validated_ || at_end_.has_value(); }
    [[nodiscard]] std::string const& failure() const { return failure_; }

    [[nodiscard]] std::string tube_csv() const {
        std::string text = "from,to";
        for (auto const& s : about_.states)
            text += std::string{","} + s.name + "_lower," + s.name + "_upper";
        text += "\n";
        for (auto const& step : spans_) {
            text += shortest(step.from) + "," + shortest(step.to);
            for (auto const& side : step.states)
                text += std::string{","} + to_decimal_lower(side.lower()) + "," +
                        to_decimal_upper(side.upper());
            text += "\n";
        }
        return text;
    }

    [[nodiscard]] std::string summary() const {
        std::string text = scenario_.name + " at t = " + shortest(line_.times.back()) + " " +
                           about_.time_unit + ":";
        for (std::size_t c = 0; c < about_.channels.size(); ++c) {
            double const y = line_.outputs.back()[c];
            text += std::string{" "} + about_.channels[c].name + " = " +
                    report::rounded_text(y, report::rounding::nearest, {.significant = 4});
        }
        if (at_end_)
            text += std::string{"\n  proved, width of the widest state: "} +
                    report::rounded_text(width(*at_end_), report::rounding::up, {.significant = 2});
        return text;
    }

    void add_to(report::page& page) const {
        page.section(scenario_.name);
        page.prose(scenario_.about);
        report::figure inputs{.panels = {}, .title = "Inputs.", .caption = "What was put in."};
        for (std::size_t i = 0; i < inputs_.size(); ++i) {
            auto c = series(about_.inputs[i].name, about_.inputs[i].unit);
            for (double const t : line_.times) c.reference.push_back({t, input(i, t)});
            inputs.panels.push_back(report::draw_time_plot(c, {.title = c.name}));
        }
        if (!inputs.panels.empty()) page.add(inputs);
        add_states(page);
        add_plane(page);
    }

private:
    [[nodiscard]] report::channel_series series(std::string const& name,
                                                std::string const& unit) const {
        return {.name = name, .unit = unit, .time_unit = about_.time_unit};
    }
    /// What a picture's band says.
    [[nodiscard]] std::string about_tube() const {
        if (!validated_) return {};
        return std::string{" The band is proved: every exact solution runs within it at every "
                           "instant"} +
               (complete() ? "" : ", as far as it goes") +
               ". Where a state stays zero the band shows rounding errors only; see the power of "
               "ten at its axis.";
    }
    void add_states(report::page& page) const {
        std::vector<report::channel_series> all;
        for (std::size_t i = 0; i < about_.states.size(); ++i) {
            auto c = series(about_.states[i].name, about_.states[i].unit);
            for (std::size_t k = 0; k < line_.times.size(); ++k)
                c.reference.push_back({line_.times[k], line_.states[k][i]});
            for (auto const& step : spans_)
                c.tube.push_back(
                    {step.from, step.to, {step.states[i].lower(), step.states[i].upper()}});
            all.push_back(std::move(c));
        }
        report::figure states{.panels = {},
                              .legend = report::time_plot_legend(all),
                              .title = "States.",
                              .caption = "The dashed line is simulated in floating point by "
                                         "Boost.Odeint and proves nothing." +
                                         about_tube()};
        for (auto const& c : all)
            states.panels.push_back(report::draw_time_plot(c, {.title = c.name}));
        page.add(states);
    }
    /// From above, where states are a position in the plane.
    void add_plane(report::page& page) const {
        if (!plane_) return;
        auto const state = [this](std::string const& name) {
            auto const names = names_in(about_.states);
            return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) -
                                            names.begin());
        };
        auto const n = about_.states.size();
        auto const i = state(plane_->x), j = state(plane_->y), heading = state(plane_->heading);
        if (i == n || j == n) return;
        report::plane_series plane;
        for (std::size_t k = 0; k < line_.states.size(); ++k) {
            auto const& x = line_.states[k];
            plane.reference.push_back({x[i], x[j]});
            auto const every = std::max<std::size_t>(line_.states.size() / 10, 1);
            if (heading < n && k % every == every / 2)
                plane.poses.push_back({x[i], x[j], x[heading]});
        }
        for (auto const& step : spans_)
            plane.tube.push_back({{step.states[i].lower(), step.states[i].upper()},
                                  {step.states[j].lower(), step.states[j].upper()}});
        page.add(report::figure{
            .panels = {report::draw_plane_plot(plane)},
            .legend = report::plane_plot_legend(plane),
            .title = "The motion seen from above.",
            .caption = "Equal scales on both axes; arrowheads show the heading." + about_tube(),
            .layout = report::panel_layout::wide});
    }

    /// The constants that were given; those with a range in its middle.
    static parameter_choice middle_of(simulate_command const& c) {
        parameter_choice result;
        auto const ranges = ranges_of(c);
        for (auto const& [name, value] : c.set)
            result.fixed[name] = ranges.count(name) > 0 ? interval(mid(value)) : value;
        return result;
    }
    static std::map<std::string, interval> ranges_of(simulate_command const& c) {
        std::map<std::string, interval> result;
        for (auto const& [name, value] : c.set) {
            if (width(value) > normalised_unknowns::negligible * mag(value))
                result.emplace(name, value);
        }
        return result;
    }
    /// The tube for all values in the ranges.
    void enclose_ranges(recorded_model const& model, simulate_command const& c,
                        std::vector<signal> const& inputs, box const& start) {
        prediction_problem p;
        p.model = model;
        for (auto const& [name, value] : c.set) p.choice.fixed[name] = value;
        std::vector<interval> sides;
        for (auto const& [name, range] : ranges_of(c)) {
            p.choice.fixed.erase(name);
            p.choice.unknown.push_back(name);
            sides.push_back(range);
        }
        p.sets = {box(sides)};
        p.inputs = inputs;
        p.initial = start;
        p.end = scenario_.duration;
        auto how = c.how;
        if (how.set.empty()) // ranges are wide
            how.set = how.method == "taylor" ? "taylor-model" : "first-order";
        // Parts end it; a loaded machine must not change the answer.
        prediction_options options{.seconds = 600, .parts = 32, .cells = 300};
        apply(how, options.run);
        auto const found = predict(p, options);
        using traits = interval_traits<interval>;
        auto const states_at = [&](std::size_t segment) {
            box x(found.states.size());
            for (std::size_t i = 0; i < x.size(); ++i)
                x[i] = traits::bounds(found.states[i].low[segment], found.states[i].high[segment]);
            return x;
        };
        for (std::size_t s = 1; s + 1 < 2 * found.times.size(); s += 2) {
            auto const x = hull(hull(states_at(s - 1), states_at(s)), states_at(s + 1));
            bool const known = std::all_of(
                x.begin(), x.end(), [](auto const& side) { return std::isfinite(mag(side)); });
            if (known) spans_.push_back({found.times[s / 2], found.times[s / 2 + 1], x});
        }
        if (found.complete)
            at_end_ = states_at(2 * found.times.size() - 2);
        else
            failure_ = scenario_.name + ": the tube over these ranges is proved up to t = " +
                       shortest(found.reached) + " " + about_.time_unit +
                       "; narrower ranges get further";
    }

    /// An input for tables and pictures.
    [[nodiscard]] double input(std::size_t i, double t) const {
        auto const* recorded = std::get_if<sampled_signal>(&inputs_[i]);
        return recorded != nullptr ? recorded->approximate(t) : scenario_.inputs[i](t);
    }

    model_description const& about_;
    std::optional<report::plane_channels> const& plane_;
    scenario_description const& scenario_;
    std::vector<signal> inputs_;
    approximate_trajectory line_;
    bool validated_ = false;
    std::vector<swept_span> spans_;
    std::optional<box> at_end_; ///< the states, when the tube gets there
    std::string failure_;       ///< why it does not
};

/// What was hidden in generated data, for the one who wants to check an answer.
inline std::string truth_json(generated const& made, generate_command const& c) {
    json_writer json;
    json.begin_object().members("format", "sivid-truth-1", "seed", c.options.seed);
    json.named("parameters", made.truth);
    json.list("outliers", made.outliers, [&](auto const& o) {
        json.object("scenario", o.scenario, "t", o.time, "channel", o.channel);
    });
    json.end_object();
    return json.text();
}

} // namespace detail

SIVID_DECL int run(robot const& r, simulate_command const& asked) {
    auto c = asked;
    auto const scenarios = find_scenarios(r, c.scenario);
    auto const with_effects = join_effects(r.model, r.effects, c.effects);
    auto const& model = with_effects.model;
    for (auto const& [name, value] : c.set)
        require_known(name, names_in(model.about.constants), "constant");
    c.set.insert(with_effects.set.begin(), with_effects.set.end()); // what is told stays
    std::vector<std::unique_ptr<detail::simulated_scenario>> all;
    for (auto const& s : scenarios)
        all.push_back(std::make_unique<detail::simulated_scenario>(r, model, s, c));
    prepare_folder(c.out);
    report::page page{
        {.kind = "Simulation",
         .title = c.scenario == "all" ? "All scenarios" : scenarios[0].name,
         .lead = r.model.about.name + (c.effects.empty() ? "" : " with " + enumeration(c.effects)) +
                 (c.validated ? ", simulated and enclosed." : ", simulated in floating point.")}};
    parameter_choice set;
    for (auto const& [name, value] : c.set) set.fixed[name] = value;
    auto const derived = derivation_words(model, set);
    if (!derived.empty()) page.bullets(derived);
    for (auto const& words : derived) result_stream() << words << "\n";
    std::vector<std::string> warnings;
    for (auto const& s : all)
        if (!s->complete()) warnings.push_back(s->failure());
    page.warnings(warnings);
    file_set files(c.out);
    for (std::size_t k = 0; k < all.size(); ++k) {
        auto const& name = scenarios[k].name;
        files.add(name + ".trajectory.csv", all[k]->trajectory_csv());
        if (all[k]->validated()) files.add(name + ".tube.csv", all[k]->tube_csv());
        all[k]->add_to(page);
        result_stream() << all[k]->summary() << "\n";
        if (!all[k]->complete()) result_stream() << "  " << all[k]->failure() << "\n";
    }
    page.footer(page_footer(c.command_line));
    files.add("simulation.html", page.str());
    files.commit();
    result_stream() << "written: " << (c.out / "simulation.html").string() << "\n";
    return done;
}

SIVID_DECL int run(robot const& r, generate_command const& c) {
    auto const names = names_of(r.model.about);
    auto const made = generate(r.model, find_scenarios(r, c.scenario), c.options);
    prepare_folder(c.out);
    file_set files(c.out);
    files.add("truth.json", detail::truth_json(made, c));
    add_dataset(files, made.data, names);
    files.commit();
    for (auto const& s : made.data.scenarios)
        result_stream() << s.name << ": " << s.measurements.size() << " measurements over "
                        << s.duration << " " << r.model.about.time_unit << "\n";
    if (made.left_out > 0)
        result_stream()
            << made.left_out
            << " samples near zero were left out: a relative bound says nothing there; use "
               "--absolute or --combined\n";
    if (!made.outliers.empty())
        result_stream() << made.outliers.size() << " outliers planted, fraction allowed "
                        << made.data.max_outlier_fraction.text() << "\n";
    result_stream() << "written: " << (c.out / "dataset.json").string()
                    << " (the planted truth is in truth.json)\n";
    return done;
}

} // namespace sivid::app

#endif

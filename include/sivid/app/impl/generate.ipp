// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_IMPL_GENERATE_IPP
#define SIVID_APP_IMPL_GENERATE_IPP

#include <sivid/app/generate.hpp>

#include <sivid/app/names.hpp>
#include <sivid/app/program.hpp>
#include <sivid/enclosure/enclosed_motion.hpp>
#include <sivid/io/dataset_writer.hpp>
#include <sivid/model/bound_model.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <random>
#include <set>
#include <utility>

namespace sivid::app {

SIVID_DECL std::vector<double> sample_times(double duration, double rate, int decimals,
                                            bool from_zero) {
    if (!(rate > 0) || !(duration * rate < 1e6))
        throw bad_request("the rate must be above 0 and give fewer than a million samples");
    std::vector<double> times;
    for (std::size_t k = from_zero ? 0 : 1;; ++k) {
        auto const t = nearest(exact_decimal::rounded(static_cast<double>(k) / rate, decimals));
        if (!(*t <= duration)) break;
        if (times.empty() || times.back() < *t) times.push_back(*t);
    }
    return times;
}

SIVID_DECL std::vector<dataset_input> record_inputs(scenario_description const& s, double rate,
                                                    int decimals, sivid::interpolation kind) {
    auto times = sample_times(s.duration, rate, decimals, true);
    if (times.back() < s.duration) times.push_back(s.duration);
    std::vector<dataset_input> inputs;
    for (auto const& shape : s.inputs) {
        std::vector<double> values;
        for (double const t : times)
            values.push_back(*nearest(exact_decimal::rounded(shape(t), decimals)));
        inputs.push_back({sampled_signal(times, std::move(values), kind), {}, {}});
    }
    return inputs;
}

namespace detail {

/// Uniform in [-1, 1], the same on every platform.
class noise_source {
public:
    explicit noise_source(std::uint64_t seed) : engine_{seed} {}
    double operator()() { return static_cast<double>(engine_() >> 11) * 0x1p-52 - 1; }
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }

private:
    std::mt19937_64 engine_;
};

class generator {
public:
    generator(recorded_model const& model, generate_options const& options)
        : model_{model}, options_{options}, noise_{options.seed} {
        if (!options.relative && options.absolute.empty())
            throw bad_request("no error bound: give --relative, --absolute or both");
        if (!options.absolute.empty() && options.absolute.size() != model.about.channels.size())
            throw bad_request(
                std::string{
                    "--absolute needs one bound for all channels, or one for each of the "} +
                std::to_string(model.about.channels.size()));
        if (!(options.noise >= 0 && options.noise <= 1))
            throw bad_request("the noise must be a share of the bound, from 0 to 1");
    }

    [[nodiscard]] generated operator()(std::vector<scenario_description> const& scenarios) {
        state_constants();
        for (auto const& s : scenarios) add_scenario(s);
        result_.data.max_outlier_fraction = outlier_fraction();
        return std::move(result_);
    }

private:
    [[nodiscard]] exact_decimal nominal(std::string const& name) const {
        auto const& all = model_.about.constants;
        return exact_decimal::shortest(all[index_of(all, name, "constant")].nominal.nearest);
    }

    void state_constants() {
        auto& data = result_.data;
        data.id = options_.id;
        data.model = model_.about.name;
        auto const& all = model_.about.constants;
        for (auto const& u : options_.unknown) {
            auto const k = index_of(all, u.name, "constant");
            auto const set = options_.set.find(u.name);
            auto const truth = set == options_.set.end() ? nominal(u.name) : set->second;
            if (u.upper < u.lower)
                throw bad_request(std::string{"the prior of "} + u.name + " is empty");
            if (truth < u.lower || u.upper < truth)
                throw bad_request(std::string{"the true value "} + truth.text() + " of " + u.name +
                                  " lies outside its prior [" + u.lower.text() + ", " +
                                  u.upper.text() + "]");
            data.parameters.push_back(
                {k, u.name, all[k].unit, {u.lower, u.upper, *enclose(u.lower, u.upper)}});
            result_.truth[u.name] = truth;
            // Stated, as in the data set: what is derived from it follows.
            true_constants_.fixed[u.name] = *enclose(truth);
        }
        for (auto const& [name, value] : options_.set) {
            true_constants_.fixed[name] = *enclose(value);
            if (result_.truth.count(name) > 0) continue;
            auto const k = index_of(all, name, "constant");
            data.fixed.push_back({k, value, *enclose(value)});
        }
    }

    void add_scenario(scenario_description const& s) {
        scenario out;
        out.name = s.name;
        out.duration = s.duration;
        out.inputs =
            record_inputs(s, options_.input_rate, options_.decimals, options_.interpolation);
        box start(s.initial.size());
        for (std::size_t i = 0; i < s.initial.size(); ++i) {
            out.initial.push_back({s.initial[i].enclosure, s.initial[i]});
            // A single number is met exactly, a range in its middle.
            start[i] = s.initial[i].lower == s.initial[i].upper
                           ? s.initial[i].enclosure
                           : interval(mid(s.initial[i].enclosure));
        }
        std::vector<signal> signals;
        for (auto const& input : out.inputs) signals.emplace_back(input.signal);
        auto const f = std::make_shared<flow const>(model_, true_constants_, signals);
        auto const motion = enclosed(options_.how, f, start, s.duration);
        if (!motion.complete())
            throw bad_request(
                std::string{"scenario "} + s.name + ": the true motion could not be enclosed: " +
                motion.failure()->message(model_.about.states[motion.failure()->component].name,
                                          model_.about.time_unit));
        auto const truth = sample_truth(out, motion);
        add_samples(out, truth, choose_outliers(truth));
        if (out.measurements.empty())
            throw bad_request(std::string{"scenario "} + s.name + ": no measurement is left");
        result_.data.scenarios.push_back(std::move(out));
    }

    struct true_sample {
        double time;
        std::size_t channel;
        interval value; ///< M_real
    };
    [[nodiscard]] std::vector<true_sample> sample_truth(scenario const& s,
                                                        enclosed_motion const& motion) {
        std::vector<true_sample> truth;
        for (double const t : sample_times(s.duration, options_.rate, options_.decimals, false)) {
            auto const y = motion.observe_at(t);
            for (std::size_t c = 0; c < y.size(); ++c) {
                // Relative bounds say nothing about a value that is stored as zero.
                bool const vanishes =
                    options_.absolute.empty() &&
                    exact_decimal::rounded(mid(y[c]), options_.decimals).is_zero();
                result_.left_out += vanishes ? 1 : 0;
                if (!vanishes) truth.push_back({t, c, y[c]});
            }
        }
        return truth;
    }

    [[nodiscard]] std::set<std::size_t> choose_outliers(std::vector<true_sample> const& truth) {
        if (options_.outliers > 0 && options_.outliers >= truth.size())
            throw bad_request("more outliers than measurements");
        std::set<std::size_t> chosen;
        while (chosen.size() < options_.outliers) chosen.insert(noise_.below(truth.size()));
        return chosen;
    }

    void add_samples(scenario& out, std::vector<true_sample> const& truth,
                     std::set<std::size_t> const& spoilt) {
        for (std::size_t i = 0; i < truth.size(); ++i) {
            auto const& t = truth[i];
            auto const stated = spoilt.count(i) > 0 ? outlier(t) : regular(t);
            auto const bound = enclose(stated.value - stated.error, stated.value + stated.error);
            out.measurements.push_back({t.time, t.channel, *bound});
            out.stated.push_back(stated);
            if (spoilt.count(i) > 0)
                result_.outliers.push_back(
                    {out.name, model_.about.channels[t.channel].name, t.time});
        }
    }

    [[nodiscard]] double relative() const {
        return options_.relative ? *nearest(*options_.relative) : 0.0;
    }
    [[nodiscard]] exact_decimal absolute(std::size_t channel) const {
        return options_.absolute.empty() ? exact_decimal{} : options_.absolute[channel];
    }
    /// The bound around a stored value, rounded up at the last decimal where it is relative.
    [[nodiscard]] exact_decimal error_of(std::size_t channel, exact_decimal const& value) const {
        if (!options_.relative) return absolute(channel);
        double const last = std::pow(10.0, -options_.decimals);
        double const share = relative() * std::fabs(*nearest(value));
        return absolute(channel) + exact_decimal::rounded(share + 0.51 * last, options_.decimals);
    }
    [[nodiscard]] static bool holds(stated_measurement const& m, interval const& truth) {
        auto const low = enclose(m.value - m.error), high = enclose(m.value + m.error);
        return low->upper() <= truth.lower() && truth.upper() <= high->lower();
    }

    /// A sample whose bound contains the truth, whatever the noise and the rounding.
    [[nodiscard]] stated_measurement regular(true_sample const& t) {
        double const middle = mid(t.value), s = relative();
        // |noise| <= absolute + s |middle + noise| for either sign of the noise.
        double noise = options_.noise * noise_() *
                       (*nearest(absolute(t.channel)) + s * std::fabs(middle)) / (1 + s);
        for (int attempt = 0; attempt < 60; ++attempt, noise *= attempt < 59 ? 0.75 : 0) {
            stated_measurement m;
            m.value = exact_decimal::rounded(middle + noise, options_.decimals);
            m.error = error_of(t.channel, m.value);
            if (m.error.is_positive() && holds(m, t.value)) return m;
        }
        throw bad_request(std::string{"the bounds are too small for "} +
                          std::to_string(options_.decimals) +
                          " decimals, or for the enclosure of the true motion");
    }

    [[nodiscard]] stated_measurement outlier(true_sample const& t) {
        double const middle = mid(t.value);
        double const bound = *nearest(absolute(t.channel)) + relative() * std::fabs(middle);
        double const sign = noise_() < 0 ? -1 : 1;
        stated_measurement m;
        m.value = exact_decimal::rounded(middle + sign * options_.outlier_size * bound,
                                         options_.decimals);
        m.error = error_of(t.channel, m.value);
        if (!disjoint(*enclose(m.value - m.error, m.value + m.error), t.value))
            throw bad_request("an outlier of this size still holds; give a larger --outlier-size");
        return m;
    }

    /// The smallest fraction, in millionths, that allows the planted outliers in every scenario.
    [[nodiscard]] exact_decimal outlier_fraction() const {
        if (options_.outliers == 0) return {};
        std::size_t least = 1'000'000;
        for (auto const& s : result_.data.scenarios) least = std::min(least, s.measurements.size());
        auto const millionths = (options_.outliers * 1'000'000 + least - 1) / least;
        return *exact_decimal::parse(std::to_string(millionths) + "e-6");
    }

    recorded_model const& model_;
    generate_options const& options_;
    noise_source noise_;
    parameter_choice true_constants_;
    generated result_;
};

} // namespace detail

SIVID_DECL generated generate(recorded_model const& model,
                              std::vector<scenario_description> const& scenarios,
                              generate_options const& options) {
    return detail::generator(model, options)(scenarios);
}

SIVID_DECL std::vector<scenario_description> find_scenarios(robot const& r,
                                                            std::string const& wanted) {
    auto const names = names_of(r.model.about);
    std::vector<scenario_description> result;
    for (auto const& s : r.scenarios) {
        if (s.name == wanted || (wanted == "all" && s.usual))
            result.push_back(parse_scenario("scenario " + s.name, s.text, names));
    }
    if (!result.empty()) return result;
    if (std::filesystem::exists(wanted)) return {read_scenario(wanted, names)};
    auto known = names_in(r.scenarios);
    if (known.empty())
        throw input_error{
            {.file = wanted}, "no such file", "give a scenario as a JSON file (sivid-scenario-1)"};
    known.insert(known.begin(), "all");
    throw input_error{{.file = wanted},
                      "no such scenario and no such file" + suggestion(wanted, known),
                      "give a JSON file, or one of: " + joined(known, ", ")};
}

SIVID_DECL scenario_description find_scenario(robot const& r, std::string const& wanted) {
    auto found = find_scenarios(r, wanted);
    if (found.size() != 1) throw bad_request("--scenario: name one scenario");
    return std::move(found.front());
}

} // namespace sivid::app

#endif

// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RUN_DETAIL_EXPERIMENT_RUN_CLASS_HPP
#define SIVID_PAVING_RUN_DETAIL_EXPERIMENT_RUN_CLASS_HPP

#include <sivid/enclosure/flow.hpp>
#include <sivid/enclosure/suggested_degree.hpp>
#include <sivid/measurement/record.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/paving/run_options.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

/// One experiment over boxes of parameters and starts: integrates, stepping onto the measurements,
/// and keeps the measured outputs as polynomials. Owns its work space; one object per thread.
class experiment_run {
public:
    virtual ~experiment_run() = default;
    /// @returns for each box of parameters the outputs that were reached; fewer than all when the
    ///          enclosure failed, became hopeless, or more measurements than allowed already fail
    ///          for the whole box
    [[nodiscard]] virtual std::vector<std::shared_ptr<response const>>
    operator()(box const& initial, std::vector<box> const& parameters) = 0;
    [[nodiscard]] std::shared_ptr<response const> operator()(box const& initial,
                                                             box const& parameters) {
        return (*this)(initial, std::vector<box>{parameters})[0];
    }
    /// How many boxes are best given together.
    [[nodiscard]] virtual std::size_t at_once() const { return 1; }
};

namespace paving_detail {

/// Number of sides of an experiment that have a width.
[[nodiscard]] inline std::size_t unknown_count(box const& initial, box const& prior) {
    return normalised_unknowns(initial, prior).variables;
}

/// Of Taylor models in so many unknowns.
[[nodiscard]] inline std::size_t degree_for(run_options const& options, std::size_t unknowns) {
    return unknowns > 0 && options.degree > 0 ? options.degree : suggested_degree(unknowns);
}

/// The steps of an experiment, relative to what it lasts (`for_span`): until its last measurement,
/// or as long as its inputs are known, while there is none.
///   A smallest step that is not much shorter than the pieces of an input ends runs that only have
/// to start gently after each knot: then every piece may take 500 steps. Samples that nearly
/// coincide do not count.
[[nodiscard]] inline enclosure_options steps_for(experiment const& e, enclosure_options options) {
    double shortest = detail::infinity, known = e.begin;
    for (auto const& input : e.inputs) {
        auto const* u = std::get_if<sampled_signal>(&input);
        if (u == nullptr) continue;
        known = std::max(known, u->times().back());
        for (std::size_t k = 1; k < u->times().size(); ++k) {
            shortest = std::min(shortest, u->times()[k] - u->times()[k - 1]);
        }
    }
    options = for_span(std::move(options), (e.end() > e.begin ? e.end() : known) - e.begin);
    if (double const piece = shortest / options.span; piece < 40 * options.minimum_step)
        options.minimum_step = std::min(options.minimum_step, std::max(piece / 500, 1e-7));
    return options;
}

/// The options of runs of one flow. What uncertain inputs cost, no smaller box gives back: such
/// runs are never hopeless.
[[nodiscard]] inline run_options options_for(flow const& f, run_options options) {
    if (f.uncertain()) options.hopeless = 1e300;
    return options;
}
/// Whether what is lost of an output exceeds `most` times what is known of it and its bound.
/// @param radius, spread  of its polynomial
[[nodiscard]] inline bool is_hopeless(double radius, double spread, interval const& bound,
                                      double most) {
    return !(2 * radius <= most * (2 * spread + width(bound)));
}

/// What an output says of a measurement.
struct kept_output {
    bool fails = false;
    bool hopeless = false;
};

/// The place of one run in the measurements of a record, which are met group by group in time.
class measurement_walk {
public:
    measurement_walk(record const& samples, std::size_t allowed)
        : samples_(&samples), allowed_(allowed) {}

    [[nodiscard]] bool done() const { return over_ || next_ >= samples_->size(); }
    /// Time of the next measurements.
    [[nodiscard]] double time() const { return (*samples_)[next_].time; }
    /// Takes the measurements of the present time.
    /// @param keep  (channel, bound) -> kept_output
    template <class Keep>
    void take(Keep&& keep) {
        double const t = time();
        bool hopeless = true;
        for (; next_ < samples_->size() && (*samples_)[next_].time == t; ++next_) {
            auto const verdict = keep((*samples_)[next_].channel, (*samples_)[next_].bound);
            failed_ += verdict.fails ? 1 : 0;
            hopeless = hopeless && verdict.hopeless;
        }
        over_ = failed_ > allowed_ || hopeless;
    }

private:
    record const* samples_;
    std::size_t allowed_;
    std::size_t next_ = 0;
    std::size_t failed_ = 0;
    bool over_ = false;
};

[[nodiscard]] inline std::shared_ptr<response> start_response(experiment const& e,
                                                              record const& samples,
                                                              box const& initial,
                                                              box const& parameters) {
    auto answer = std::make_shared<response>(
        response{normalised_unknowns(initial, parameters), nullptr, {}, {}, {}, {}, 0, 0});
    answer->measurements = samples.size();
    answer->allowed = e.outliers;
    return answer;
}

} // namespace paving_detail

} // namespace sivid

#endif

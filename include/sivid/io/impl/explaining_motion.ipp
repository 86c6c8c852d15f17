// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_EXPLAINING_MOTION_IPP
#define SIVID_IO_IMPL_EXPLAINING_MOTION_IPP

#include <sivid/io/explaining_motion.hpp>

#include <sivid/compiled.hpp>
#include <sivid/enclosure/observation.hpp>
#include <sivid/enclosure/tube.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/space/box.hpp>

#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace sivid {

namespace io_detail {

/// Encloses the outputs at the measurements of an experiment, as far as the tube and the time go.
inline std::vector<interval> outputs_along(tube<interval> const& motion, record const& samples,
                                           std::function<bool()> const& keep_going) {
    using traits = interval_traits<interval>;
    std::vector<interval> result(samples.size(), traits::entire());
    observer<interval> look(motion.equations());
    look.set_ensemble(motion.ensemble());
    std::vector<observation<interval>> seen;
    double seen_at = std::nan("");
    for (std::size_t i = 0; i < samples.size(); ++i) {
        auto const& m = samples[i];
        if (!(motion.begin_time() <= m.time && m.time <= motion.end_time())) continue;
        if (m.time != seen_at) {
            if (keep_going && !keep_going()) break;
            seen = look(motion.set_at(m.time));
            seen_at = m.time;
        }
        if (seen[m.channel].defined) result[i] = seen[m.channel].value;
    }
    return result;
}

/// So many steps do for a picture, knots and measurements included: a set that needs more says no
/// more for it.
inline std::size_t steps_for(experiment const& e, std::size_t pieces) {
    std::size_t stops = pieces + e.measurements.size();
    for (auto const& input : e.inputs) {
        if (auto const* u = std::get_if<sampled_signal>(&input)) stops += u->times().size();
    }
    return 2000 + 4 * stops;
}

/// Whether the drawn tubes alone show that at most `outliers` measurements of each experiment fail.
inline bool shows_explanation(identification_problem const& problem,
                              explaining_motion const& motion) {
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        auto const samples = sorted(problem.experiments[e].measurements);
        std::size_t open = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            open += subset(motion.outputs[e][i], samples[i].bound) ? 0 : 1;
        }
        if (open > problem.experiments[e].outliers) return false;
    }
    return true;
}

/// The middle part of a box, half as wide; every part of an inside box is inside.
inline box middle_half(box x) {
    for (std::size_t j = 0; j < x.size(); ++j) {
        double const m = mid(x[j]);
        x[j] = intersect(x[j], interval_traits<interval>::bounds(m / 2 + x[j].lower() / 2,
                                                                 m / 2 + x[j].upper() / 2));
    }
    return x;
}

} // namespace io_detail

SIVID_DECL explaining_motion enclose_motion(identification_problem const& problem,
                                            motion_source source, box parameters,
                                            std::vector<box> starts, std::size_t pieces,
                                            std::function<bool()> const& keep_going) {
    explaining_motion motion{source, std::move(parameters), std::move(starts), {}, {}, {}};
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        auto const& s = problem.experiments[e];
        auto const f =
            std::make_shared<flow const>(problem.model, problem.choice, nominal(s.inputs),
                                         region_of_runs{motion.starts[e], motion.parameters});
        double const end = s.end();
        enclosure_options options;
        if (pieces > 0) options.maximum_step = (end - s.begin) / static_cast<double>(pieces);
        options.maximum_steps = io_detail::steps_for(s, pieces);
        options.keep_going = keep_going;
        motion.flows.push_back(f);
        motion.tubes.push_back(std::make_shared<tube<interval>>(
            integrate<interval>(f, motion.starts[e], motion.parameters, s.begin, end, options)));
        motion.outputs.push_back(
            io_detail::outputs_along(*motion.tubes[e], sorted(s.measurements), keep_going));
    }
    return motion;
}

SIVID_DECL std::optional<explaining_motion>
find_explaining_motion(identification_problem const& problem, identification const& found,
                       std::size_t pieces, std::function<bool()> const& keep_going) {
    std::vector<box> starts;
    for (auto const& s : problem.experiments) starts.push_back(s.initial);
    auto const points = [](std::vector<std::vector<double>> const& all) {
        std::vector<box> result;
        for (auto const& x : all) result.push_back(point_box(x));
        return result;
    };
    // Inside boxes are proved for the starts of the guess, where there is one.
    if (found.guess && found.guess->starts.size() == starts.size()) {
        starts = points(found.guess->starts);
    }
    box const* largest = nullptr;
    double volume = 0;
    for (auto const& b : found.paving.boxes()) {
        if (b.verdict != box_verdict::inside) continue;
        double const v = relative_volume(b.set, problem.prior).upper();
        if (largest == nullptr || v > volume) {
            largest = &b.set;
            volume = v;
        }
    }
    if (largest != nullptr) {
        auto part = *largest;
        for (int attempt = 0; attempt < 5 && (!keep_going || keep_going()); ++attempt) {
            auto motion = enclose_motion(problem, motion_source::inside_box, part, starts, pieces,
                                         keep_going);
            if (io_detail::shows_explanation(problem, motion)) return motion;
            part = io_detail::middle_half(part);
        }
    }
    if (keep_going && !keep_going()) return std::nullopt;
    if (found.witness) {
        return enclose_motion(problem, motion_source::witness, point_box(found.witness->parameters),
                              points(found.witness->starts), pieces, keep_going);
    }
    if (found.guess && !found.guess->parameters.empty()) {
        return enclose_motion(problem, motion_source::best_guess,
                              point_box(found.guess->parameters), starts, pieces, keep_going);
    }
    return std::nullopt;
}

} // namespace sivid

#endif

// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_DETAIL_EXPLAINING_MOTION_SEARCH_HPP
#define SIVID_IO_DETAIL_EXPLAINING_MOTION_SEARCH_HPP

#include <sivid/compiled.hpp>
#include <sivid/enclosure/tube.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/paving/problem.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace sivid {

SIVID_ENTRY std::vector<interval> explaining_motion::outputs_of(std::size_t e,
                                                                record const& samples) const {
    std::vector<interval> result;
    auto const& tube = *tubes[e];
    std::optional<box> outputs;
    double time = 0;
    for (auto const& m : samples) {
        if (!outputs || m.time != time) {
            bool const covered = tube.begin_time() <= m.time && m.time <= tube.end_time();
            outputs = covered ? tube.observe_at(m.time) : box{};
            time = m.time;
        }
        result.push_back(outputs->size() > m.channel ? (*outputs)[m.channel]
                                                     : interval_traits<interval>::entire());
    }
    return result;
}

namespace io_detail {

inline explaining_motion enclose_motion(identification_problem const& problem, motion_source source,
                                        box parameters, std::vector<box> starts,
                                        std::size_t pieces) {
    explaining_motion motion{source, std::move(parameters), std::move(starts), {}, {}};
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        auto const& s = problem.experiments[e];
        auto const f =
            std::make_shared<flow const>(problem.model, problem.choice, nominal(s.inputs));
        double const end = last_measurement(s);
        enclosure_options options;
        if (pieces > 0) options.maximum_step = (end - s.begin) / static_cast<double>(pieces);
        motion.flows.push_back(f);
        motion.tubes.push_back(std::make_shared<tube<interval>>(
            integrate<interval>(f, motion.starts[e], motion.parameters, s.begin, end, options)));
    }
    return motion;
}

/// Whether the drawn tubes alone show that at most `outliers` measurements of each experiment fail.
inline bool shows_explanation(identification_problem const& problem,
                              explaining_motion const& motion) {
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        auto const& samples = problem.experiments[e].measurements;
        auto const outputs = motion.outputs_of(e, samples);
        std::size_t open = 0;
        for (std::size_t i = 0; i < samples.size(); ++i) {
            open += subset(outputs[i], samples[i].bound) ? 0 : 1;
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

SIVID_ENTRY std::optional<explaining_motion>
find_explaining_motion(identification_problem const& problem, identification const& found,
                       std::size_t pieces) {
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
        for (int attempt = 0; attempt < 5; ++attempt) {
            auto motion =
                io_detail::enclose_motion(problem, motion_source::inside_box, part, starts, pieces);
            if (io_detail::shows_explanation(problem, motion)) return motion;
            part = io_detail::middle_half(part);
        }
    }
    if (found.witness) {
        return io_detail::enclose_motion(problem, motion_source::witness,
                                         point_box(found.witness->parameters),
                                         points(found.witness->starts), pieces);
    }
    if (found.guess && !found.guess->parameters.empty()) {
        return io_detail::enclose_motion(problem, motion_source::best_guess,
                                         point_box(found.guess->parameters), starts, pieces);
    }
    return std::nullopt;
}

} // namespace sivid

#endif

// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_PRODUCTS_CHANGE_OF_VARIABLES_HPP
#define SIVID_PAVING_PRODUCTS_CHANGE_OF_VARIABLES_HPP

#include <sivid/model/change/detail/substitution.hpp>
#include <sivid/model/graph/recorded_map.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identification.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Coordinates q in which a user wants parameters p to be searched: q = f(p) and p = f^-1(q).
struct change_of_variables {
    struct coordinate {
        std::string name, unit;
    };
    std::vector<coordinate> coordinates;
    recorded_map forward;  ///< the coordinates of given parameters, in the order of the problem
    recorded_map backward; ///< the parameters of given coordinates
};

/// `change({{"LSg", "m^3"}, {"L", "m"}}, forward, backward)` with two functors on a vector of any
/// scalar, which return vectors.
template <class Forward, class Backward>
[[nodiscard]] change_of_variables change(std::vector<change_of_variables::coordinate> coordinates,
                                         std::size_t parameters, Forward const& forward,
                                         Backward const& backward) {
    auto const n = coordinates.size();
    return {std::move(coordinates), recorded_map(parameters, forward), recorded_map(n, backward)};
}

/// An identification problem posed in other coordinates.
///   Its prior is a box around the image of the parameters' prior. That the parameters lie in their
///   own prior is one more experiment, a constraint: its channels show the parameters, and its
///   "measurements" are the sides of the prior. So q is feasible exactly when the parameters that
///   it stands for are in their prior and explain the data; verdicts, hulls, pavings and witnesses
///   of the posed problem are those of the original one, seen in q.
/// @given  backward(forward(p)) = p for every p in the prior: tried at some points, and refuted
/// there
///         by enclosures when it is wrong, but the user's promise
class changed_problem {
public:
    /// @throws std::invalid_argument  when sizes do not fit, a map is not defined on all of the
    /// prior,
    ///         or the maps are no inverses of each other
    changed_problem(identification_problem const& original, change_of_variables change)
        : original_(original), change_(std::move(change)), posed_(original) {
        original.require_valid();
        auto const& prior = original.prior;
        if (change_.forward.arguments() != prior.size() ||
            change_.backward.values() != prior.size() ||
            change_.forward.values() != change_.coordinates.size() ||
            change_.backward.arguments() != change_.coordinates.size()) {
            throw std::invalid_argument("change of variables: the maps do not have the sizes of "
                                        "the prior and the coordinates");
        }
        auto const image = change_.forward.over(prior);
        if (!image || !std::all_of(image->begin(), image->end(),
                                   [](interval const& side) { return std::isfinite(mag(side)); })) {
            throw std::invalid_argument("change of variables: the coordinates are not defined, or "
                                        "not bounded, on the prior");
        }
        try_inverse();
        pose(*image);
    }

    /// The problem in the coordinates, for what asks which of them explain the data: `identify`,
    /// `identify_by_bisection`, `online_identification`. What grows or counts measurements
    /// (inflation, fewest outliers, identifiability, diagnosis) refuses it: the parameters' prior
    /// is no data.
    [[nodiscard]] identification_problem const& problem() const { return posed_; }

    /// Encloses the parameters of all coordinates in q that lie in their prior; empty sides when
    /// there are none.
    [[nodiscard]] box parameters(box const& q) const {
        auto const p = change_.backward.over(q);
        return p ? intersect(*p, original_.prior) : original_.prior;
    }

    /// A box that contains every feasible parameter of the original problem: the hull of what the
    /// boxes of a result stand for.
    [[nodiscard]] box parameter_hull(identification const& found) const {
        box result = empty_box(original_.prior.size());
        for (auto const& b : found.paving.boxes()) {
            auto const left = intersect(b.set, found.hull);
            if (b.verdict == box_verdict::outside || is_empty(left)) continue;
            result = hull(result, parameters(left)); // what is empty adds nothing
        }
        return result;
    }

    /// Encloses the parameters of a witness, which explain the data.
    [[nodiscard]] std::optional<box> parameters_of_witness(identification const& found) const {
        if (!found.witness) return std::nullopt;
        return parameters(point_box(found.witness->parameters));
    }

private:
    /// At a few points of the prior, by enclosures: disjoint from the point, they refute.
    void try_inverse() const {
        for (int k = 0; k < 5; ++k) {
            box p(original_.prior.size());
            for (std::size_t j = 0; j < p.size(); ++j) {
                auto const& side = original_.prior[j];
                double const share =
                    std::fmod(0.5 + 0.6180339887 * k * static_cast<double>(j + 1), 1.0);
                p[j] = interval(
                    std::clamp(side.lower() + share * width(side), side.lower(), side.upper()));
            }
            auto const q = change_.forward.over(p);
            auto const back = q ? change_.backward.over(*q) : std::nullopt;
            if (!back || is_empty(intersect(*back, p))) {
                throw std::invalid_argument(
                    "change of variables: the map back from the coordinates "
                    "is not the inverse of the map to them");
            }
        }
    }

    void pose(box const& image) {
        auto const channels = original_.model.about.channels.size();
        std::vector<model_description::constant> fresh;
        posed_.choice.unknown.clear();
        for (std::size_t k = 0; k < change_.coordinates.size(); ++k) {
            auto const& c = change_.coordinates[k];
            double const middle = mid(image[k]);
            fresh.push_back({c.name, c.unit, literal{interval(middle), middle}});
            posed_.choice.unknown.push_back(c.name);
        }
        posed_.model =
            substituted(original_.model, original_.choice.unknown, fresh, change_.backward, true);
        posed_.prior = image;
        experiment within;
        auto const& like = original_.experiments.front();
        within.name = "prior of the parameters";
        within.inputs = nominal(like.inputs);
        within.begin = like.begin;
        within.initial = point_box(mid(like.initial));
        within.constraint = true;
        for (std::size_t j = 0; j < original_.prior.size(); ++j) {
            within.measurements.push_back({like.begin, channels + j, original_.prior[j]});
        }
        posed_.experiments.push_back(std::move(within));
    }

    identification_problem original_;
    change_of_variables change_;
    identification_problem posed_;
};

} // namespace sivid

#endif

// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_DESIGN_PROMISE_TYPES_HPP
#define SIVID_DECISION_DESIGN_PROMISE_TYPES_HPP

#include <sivid/compiled.hpp>
#include <sivid/decision/prediction_problem.hpp>
#include <sivid/paving/run_options.hpp>

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

namespace sivid {

/// What an experiment will measure.
struct planned_measurements {
    std::vector<double> times;  ///< within the experiment, in its unit
    std::vector<double> errors; ///< bound of the errors of each channel; 0: it is not measured

    /// Every `period` seconds, the end included.
    [[nodiscard]] static planned_measurements every(double period, double end,
                                                    std::vector<double> errors);
    /// Calls what(time, channel, error) for each measurement.
    template <class What>
    void for_each(What const& what) const {
        for (double const t : times) {
            for (std::size_t c = 0; c < errors.size(); ++c) {
                if (errors[c] > 0) what(t, c, errors[c]);
            }
        }
    }
    /// @throws std::invalid_argument that names what does not fit
    void require_valid(prediction_problem const& p) const;
};

/// How hard a promise is sharpened.
struct promise_options {
    double seconds = 10;
    std::size_t pairs = 200; ///< of parts, at most so many
    /// Widths that are this share of what they were are small enough.
    double target = 0;
    run_options run{};
    std::function<bool()> keep_going{}; ///< false ends the work; what is proved stays proved
};

/// How far the values of a goal lie apart.
struct promised_width {
    double before = 0; ///< two parameters of the sets, that are reached, differ by at least this,
    double most = 0;   ///< and none by more than this;
    /// and whatever the experiment shows, those that explain it by no more than this.
    double after = std::numeric_limits<double>::infinity();

    /// after / before, rounded up; 1 at most where nothing is gained.
    [[nodiscard]] double factor() const;
};

struct promise {
    std::vector<promised_width> goals;
    double reached = 0; ///< all motions are enclosed up to this time; later data promise nothing
    /// Of two models: no parameter of the one and of the other explain the same data.
    bool told_apart = false;
    std::size_t pairs = 0, integrations = 0;
    double seconds = 0;
};

} // namespace sivid

#endif

// SPDX-License-Identifier: MIT
// Fits a model with chosen effects to a recording: weighted least squares, the worst samples that
// the outlier budget allows left out; then p-norms towards the smallest inflation.
#ifndef WITHHELD_FIT_HPP
#define WITHHELD_FIT_HPP

#include "catalogue.hpp"
#include "least_squares.hpp"
#include "recorded.hpp"

#include <string>
#include <utility>
#include <vector>

namespace withheld {

struct variable {
    std::string name; // "Sv", "wind.wx" or "S3:u"
    double lo = 0, hi = 1;
    double constants::*constant = nullptr;
    double effect_values::*effect = nullptr;
    std::size_t state = 0, scenario = 0; // of an uncertain start, when both are null
    bool is_start() const { return constant == nullptr && effect == nullptr; }
};

class fit_problem {
public:
    fit_problem(recording const& data, std::vector<effect const*> const& effects);

    std::vector<variable> const& variables() const { return variables_; }
    std::size_t samples() const { return samples_; }
    /// Scaled to [0, 1], from values; the middle of each interval where none is given.
    std::vector<double> start(std::vector<std::pair<std::string, double>> const& values) const;
    std::vector<std::pair<std::string, double>> values(std::vector<double> const& x) const;

    /// Misfits in units of their bounds, and how they change with each variable.
    struct linear_model {
        std::vector<double> misfit;
        std::vector<std::vector<double>> slope; // by variable
    };
    /// Of the fit scenarios, or of the others with the starts in the middle of their boxes.
    linear_model linear(std::vector<double> const& x, bool holdout = false) const;
    /// Those of `linear` alone.
    std::vector<double> misfits(std::vector<double> const& x, bool holdout = false) const;
    /// Least squares for power 2; larger powers come closer to the smallest largest misfit.
    double minimise(std::vector<double>& x, double power, int iterations) const;
    /// Of the fit scenarios, or of the others with the starts in the middle of their boxes.
    double inflation(std::vector<double> const& x, bool holdout = false) const;
    /// Lowers the inflation by p-norms from a least-squares fit; returns it.
    double tighten(std::vector<double>& x) const;

private:
    using residuals = std::vector<std::vector<double>>; // by scenario
    residuals evaluate(std::vector<double> const& x, bool holdout, double step) const;
    normal_equations linearised(std::vector<double> const& x, double power, double scale) const;
    struct difference_quotients {
        residuals z;
        std::vector<residuals> moved; // by variable; of other scenarios where it is a start
        std::vector<double> step;
        double slope(std::size_t i, std::size_t s, std::size_t m) const {
            return (moved[i][s][m] - z[s][m]) / step[i];
        }
    };
    difference_quotients differences(std::vector<double> const& x, bool holdout = false) const;
    bool elsewhere(std::size_t i, std::size_t scenario) const {
        return variables_[i].is_start() && variables_[i].scenario != scenario;
    }

    recording const& data_;
    std::vector<variable> variables_;
    std::size_t samples_ = 0;
};

struct fit_result {
    std::vector<double> x;
    double rss = 0, inflation = 0, criterion = 0; // criterion: BIC for uniform noise
};

/// The best of some starts; see the source for which.
fit_result fit(fit_problem const& problem, std::vector<effect const*> const& effects,
               std::vector<std::pair<std::string, double>> const& known);

} // namespace withheld

#endif

// SPDX-License-Identifier: MIT
#ifndef HOVERCRAFT_GENERATE_HPP
#define HOVERCRAFT_GENERATE_HPP

#include "enclosing.hpp"
#include "scenario.hpp"

#include <sivid/io/dataset_value.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/measurement/signal.hpp>
#include <sivid/model/model.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace hovercraft_example {

/// A request that cannot be met: the message says why.
class bad_request : public std::invalid_argument {
public:
    using std::invalid_argument::invalid_argument;
};

struct unknown_parameter {
    std::string name;
    sivid::exact_decimal lower, upper; ///< its prior
};

struct generate_options {
    std::string id = "generated";
    std::uint64_t seed = 1;
    double rate = 10;       ///< measurements a second
    double input_rate = 20; ///< input samples a second
    sivid::interpolation interpolation = sivid::interpolation::linear;
    int decimals = 6; ///< after the point, of every number stored
    /// The bound of channel i is absolute[i] + relative |value|; either may be missing.
    std::optional<sivid::exact_decimal> relative;
    std::vector<sivid::exact_decimal> absolute; ///< empty, or one per channel
    double noise = 0.5;       ///< largest noise as a share of what the bound allows, in [0, 1]
    std::size_t outliers = 0; ///< in each scenario
    double outlier_size = 20; ///< their distance from the truth, in bounds
    std::map<std::string, sivid::exact_decimal> set; ///< true values that differ from the nominal
    std::vector<unknown_parameter> unknown;
    enclosing how{.set = "first-order"}; ///< of the true motion
};

/// A sample that was spoilt on purpose.
struct planted_outlier {
    std::string scenario, channel;
    double time = 0;
};

struct generated {
    sivid::dataset data;
    std::map<std::string, sivid::exact_decimal> truth; ///< of the unknown parameters
    std::vector<planted_outlier> outliers;
    std::size_t left_out = 0; ///< samples whose bound would have been zero
};

/// The times 1/rate, 2/rate, ... up to the duration, as decimals.
[[nodiscard]] std::vector<double> sample_times(double duration, double rate, int decimals,
                                               bool from_zero);

/// The inputs of a scenario as a recorder stores them; the last sample is at the end.
[[nodiscard]] std::vector<sivid::dataset_input>
record_inputs(scenario_description const& s, double rate, int decimals, sivid::interpolation kind);

/// Records a campaign.
/// @guarantee  the true parameters and starts explain all samples but the planted outliers: the
///             enclosure of their true output lies within each bound, as decimals
/// @throws bad_request, or std::invalid_argument for an unknown constant
[[nodiscard]] generated generate(sivid::recorded_model const& model,
                                 std::vector<scenario_description> const& scenarios,
                                 generate_options const& options);

} // namespace hovercraft_example

#endif

// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_GENERATE_HPP
#define SIVID_APP_GENERATE_HPP

#include <sivid/app/enclosing.hpp>
#include <sivid/app/robot.hpp>
#include <sivid/compiled.hpp>
#include <sivid/io/dataset_value.hpp>
#include <sivid/io/scenario.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/measurement/signal.hpp>
#include <sivid/model/model.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sivid::app {

struct generate_options {
    std::string id = "generated";
    std::uint64_t seed = 1;
    double rate = 10;       ///< measurements a second
    double input_rate = 20; ///< input samples a second
    sivid::interpolation interpolation = sivid::interpolation::linear;
    int decimals = 6; ///< after the point, of every number stored
    /// The bound of channel i is absolute[i] + relative |value|; either may be missing.
    std::optional<exact_decimal> relative;
    std::vector<exact_decimal> absolute; ///< empty, or one per channel
    double noise = 0.5;       ///< largest noise as a share of what the bound allows, in [0, 1]
    std::size_t outliers = 0; ///< in each scenario
    double outlier_size = 20; ///< their distance from the truth, in bounds
    std::map<std::string, exact_decimal> set; ///< true values that differ from the nominal
    std::vector<unknown_parameter> unknown;
    enclosing how{.set = "first-order"}; ///< of the true motion
};

/// A sample that was spoilt on purpose.
struct planted_outlier {
    std::string scenario, channel;
    double time = 0;
};

struct generated {
    dataset data;
    std::map<std::string, exact_decimal> truth; ///< of the unknown parameters
    std::vector<planted_outlier> outliers;
    std::size_t left_out = 0; ///< samples whose bound would have been zero
};

/// The times 1/rate, 2/rate, ... up to the duration, as decimals.
[[nodiscard]] SIVID_DECL std::vector<double> sample_times(double duration, double rate,
                                                          int decimals, bool from_zero);

/// The inputs of a scenario as a recorder stores them; the last sample is at the end.
[[nodiscard]] SIVID_DECL std::vector<dataset_input>
record_inputs(scenario_description const& s, double rate, int decimals, sivid::interpolation kind);

/// Records a campaign.
/// @guarantee  the true parameters and starts explain all samples but the planted outliers: the
///             enclosure of their true output lies within each bound, as decimals
/// @throws bad_request, or std::invalid_argument for an unknown constant
[[nodiscard]] SIVID_DECL generated generate(recorded_model const& model,
                                            std::vector<scenario_description> const& scenarios,
                                            generate_options const& options);

/// The scenarios that a command line asks for: "all" (the usual ones that are built in), the name
/// of a built-in one, or a file.
/// @throws input_error
[[nodiscard]] SIVID_DECL std::vector<scenario_description>
find_scenarios(robot const& r, std::string const& wanted);
/// The one that is asked for. @throws input_error, bad_request
[[nodiscard]] SIVID_DECL scenario_description find_scenario(robot const& r,
                                                            std::string const& wanted);

} // namespace sivid::app

#ifndef SIVID_COMPILED
#include <sivid/app/impl/generate.ipp>
#endif

#endif

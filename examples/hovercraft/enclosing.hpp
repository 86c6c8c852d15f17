// SPDX-License-Identifier: MIT
#ifndef HOVERCRAFT_ENCLOSING_HPP
#define HOVERCRAFT_ENCLOSING_HPP

#include <sivid/enclosure/enclosed_motion.hpp>
#include <sivid/enclosure/options.hpp>
#include <sivid/paving/run_options.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hovercraft_example {

/// `--method` and `--set`: how trajectories are enclosed.
struct enclosing {
    std::string method = "taylor"; ///< or one of `method_names`
    std::string set;               ///< first-order or taylor-model
};

/// taylor, and every Runge-Kutta method that sivid has.
[[nodiscard]] std::vector<std::string> method_names();

/// The method's coefficients; none for the Taylor series.
/// @throws bad_request  for a method that does not exist
[[nodiscard]] std::optional<sivid::tableau> method_of(enclosing const& how);

/// Whether it says what experiments do anyway: Taylor models that follow the Taylor series.
[[nodiscard]] inline bool is_usual(enclosing const& how) {
    return how.method == "taylor" && how.set == "taylor-model";
}

/// Lets what runs experiments enclose so.
void apply(enclosing const& how, sivid::run_options& run);
/// The method alone, for sets of first order.
void apply(enclosing const& how, sivid::enclosure_options& options);

/// The motions from a box of starts.
[[nodiscard]] sivid::enclosed_motion enclosed(enclosing const& how,
                                              std::shared_ptr<sivid::flow const> f,
                                              sivid::box const& start, double duration,
                                              sivid::enclosure_options options = {});

} // namespace hovercraft_example

#endif

// SPDX-License-Identifier: MIT
#ifndef SIVID_APP_ROBOT_OF_TEXT_HPP
#define SIVID_APP_ROBOT_OF_TEXT_HPP

#include <sivid/app/robot.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/text/text_model.hpp>

#include <cstddef>
#include <string>
#include <utility>

namespace sivid::app {

/// The robot whose model is a text, with the priors and effects that stand there.
/// @param name  of the program
/// @param file  of the model, as people name it
[[nodiscard]] inline robot robot_of_text(std::string name, std::string file, text_model text) {
    auto const about =
        text.about.empty() ? text.model.about.name + ", a model in " + file : text.about;
    robot result{std::move(name), about, std::move(text.model), std::move(text.effects),
                 std::move(file)};
    result.disturbances = std::move(text.disturbances);
    for (std::size_t j = 0; j < text.unknown.size(); ++j)
        result.prior.push_back({text.unknown[j], exact_decimal::of(text.prior[j].lower()),
                                exact_decimal::of(text.prior[j].upper())});
    return result;
}

} // namespace sivid::app

#endif

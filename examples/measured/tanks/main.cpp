// SPDX-License-Identifier: MIT
// tanks COMMAND ...: what two tanks without rims leave out of a measured record, which
// `tanks import mapping.json` turns into the data set.
#include "effects.hpp"
#include "model.hpp"

#include <sivid/app/app.hpp>

#include <iostream>

int main(int argc, char** argv) {
    auto const robot =
        sivid::app::robot_of("tanks", "What two tanks without rims leave out of a record",
                             cascaded_tanks{}, tanks::catalogue());
    return sivid::app::run(robot, argc, argv, {std::cout, std::cerr});
}

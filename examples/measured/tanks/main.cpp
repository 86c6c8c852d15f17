// SPDX-License-Identifier: MIT
// tanks DATASET --out DIR: what two tanks without rims leave out of a measured record, which
// `sivid-import mapping.json` turns into the data set.
#include "console/robot_program.hpp"
#include "effects.hpp"
#include "model.hpp"

int main(int argc, char** argv) {
    return console::robot_program("tanks", "What two tanks without rims leave out of a record",
                                  cascaded_tanks{}, tanks::catalogue(), argc, argv);
}

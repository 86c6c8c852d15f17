// SPDX-License-Identifier: MIT
// The reference example on the command line: hovercraft COMMAND ... (--help).
#include "craft.hpp"

#include <sivid/app/app.hpp>

#include <iostream>

int main(int argc, char** argv) {
    return sivid::app::run(hovercraft_example::craft(), argc, argv, {std::cout, std::cerr});
}

// SPDX-License-Identifier: MIT
#ifndef SIVID_NUMBER_TEXT_NEEDED_GIVEN_HPP
#define SIVID_NUMBER_TEXT_NEEDED_GIVEN_HPP

#include <cstddef>
#include <string>

namespace sivid {

/// ": 2 are needed, 3 were given", the end of a message about a count.
[[nodiscard]] inline std::string needed_given(std::size_t needed, std::size_t given) {
    return ": " + std::to_string(needed) + (needed == 1 ? " is" : " are") + " needed, " +
           std::to_string(given) + (given == 1 ? " was" : " were") + " given";
}

} // namespace sivid

#endif

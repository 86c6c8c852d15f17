// SPDX-License-Identifier: MIT
// What a forger does who has the program: all that follows from the boxes is stated anew.
#ifndef SIVID_TESTS_VERIFIER_FORGERY_HPP
#define SIVID_TESTS_VERIFIER_FORGERY_HPP

#include <sivid/verifier/claim/detail/restated.hpp>

#include <map>
#include <string>

namespace io_support {

inline void adapt(sivid::identification_problem const& problem,
                  sivid::stored_identification& stored) {
    auto found = sivid::io_detail::restate(problem, stored).found;
    found.verdict = stored.verdict;
    auto const follows = sivid::io_detail::members_of(problem, found, {});
    std::erase_if(stored.stated, [](auto const& member) {
        return !member.first.starts_with("/outputs") &&
               !member.first.starts_with("/identifiability");
    });
    stored.stated.insert(follows.begin(), follows.end());
}

} // namespace io_support

#endif

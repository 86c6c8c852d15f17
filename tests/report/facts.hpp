// SPDX-License-Identifier: MIT
#ifndef SIVID_TESTS_REPORT_FACTS_HPP
#define SIVID_TESTS_REPORT_FACTS_HPP

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

/// What a test asks of prose: names, numbers and "proved" or "estimate" in their order, whatever
/// the words between them.
namespace sivid_tests {

/// The first fact that does not stand after those before it; empty where all do.
inline std::string missing_fact(std::string_view text,
                                std::initializer_list<std::string_view> facts) {
    std::size_t at = 0;
    for (std::string_view const fact : facts) {
        auto const found = text.find(fact, at);
        if (found == std::string_view::npos)
            return std::string{fact} + " in: " + std::string{text.substr(at)};
        at = found + fact.size();
    }
    return {};
}

/// How often a text claims a proof, and how often an estimate.
struct claims {
    std::size_t proved = 0, estimates = 0;
    bool operator==(claims const&) const = default;
};
inline claims claims_of(std::string_view text) {
    auto const count = [&](std::string_view word) {
        std::size_t n = 0;
        for (auto at = text.find(word); at != std::string_view::npos;
             at = text.find(word, at + word.size()))
            ++n;
        return n;
    };
    return {count("proved") - count("not proved"), count("estimate")};
}

} // namespace sivid_tests

#endif

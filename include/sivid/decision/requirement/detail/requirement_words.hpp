// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_REQUIREMENT_DETAIL_REQUIREMENT_WORDS_HPP
#define SIVID_DECISION_REQUIREMENT_DETAIL_REQUIREMENT_WORDS_HPP

#include <sivid/decision/requirement/requirement_types.hpp>
#include <sivid/model/detail/formula_words.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace sivid::decision_detail {

/// The words of a requirement, or of a control law.
/// @param what  the text is, for messages; a literal
[[nodiscard]] inline model_detail::formula_words requirement_words(std::string_view what,
                                                                   std::string_view text) {
    static constexpr std::array<std::string_view, 10> kept{
        "and", "or", "not", "implies", "until", "always", "eventually", "at", "in", "end"};
    auto const fail = [what, text](std::size_t position, std::string const& problem,
                                   std::string const& remedy) {
        throw requirement_error(what, text, position, problem, remedy);
    };
    return {text, {.fail = fail, .kept = kept}};
}

} // namespace sivid::decision_detail

#endif

// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_IMPL_REQUIREMENT_IPP
#define SIVID_DECISION_IMPL_REQUIREMENT_IPP

#include <sivid/decision/requirement.hpp>

#include <sivid/compiled.hpp>
#include <sivid/decision/requirement/detail/requirement_parser.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace sivid {

namespace decision_detail {

/// Text of a message: what does not print is shown as a question mark, what is long is cut.
inline std::string shown_text(std::string_view text, std::size_t most = 60) {
    std::string result;
    for (char const c : text.substr(0, most)) {
        auto const byte = static_cast<unsigned char>(c);
        result += byte >= 0x20 && byte < 0x7f ? c : '?';
    }
    return text.size() > most ? result + "..." : result;
}

inline std::string located(std::string_view what, std::string_view text, std::size_t position,
                           std::string const& problem, std::string const& remedy) {
    std::size_t const from = position > 20 ? position - 20 : 0;
    auto message = std::string(what) + ": character " + std::to_string(position + 1);
    if (position < text.size()) {
        message += ", at '" + shown_text(text.substr(position), 20) + "'";
        if (from > 0 || position > 0)
            message += " behind '" + shown_text(text.substr(from, position - from)) + "'";
    } else {
        message += " (the end)";
    }
    return message + ": " + problem + "; " + remedy;
}

} // namespace decision_detail

SIVID_DECL requirement_error::requirement_error(std::string_view what, std::string_view text,
                                                std::size_t position, std::string const& problem,
                                                std::string const& remedy)
    : std::invalid_argument(decision_detail::located(what, text, position, problem, remedy)),
      position_(position) {}

SIVID_DECL requirement parse_requirement(std::string_view text, recorded_model& model, double end) {
    if (!(end > 0) || !std::isfinite(end))
        throw std::invalid_argument("parse_requirement: the motion needs a duration above 0, not " +
                                    nearest_text(end));
    return decision_detail::requirement_parser(text, model, end).read();
}

} // namespace sivid

#endif

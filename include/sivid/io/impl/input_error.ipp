// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IMPL_INPUT_ERROR_IPP
#define SIVID_IO_IMPL_INPUT_ERROR_IPP

#include <sivid/io/input_error.hpp>

namespace sivid {

SIVID_DECL std::string input_error::message(input_place const& place, std::string const& problem,
                                            std::string const& remedy) {
    std::string text = printable_path(place.file);
    if (place.is_json) {
        text += text_of(": ", place.pointer.empty() ? std::string{"(document)"}
                                                    : printable_text(place.pointer, 120));
    }
    if (place.line > 0) text += text_of(": line ", std::to_string(place.line));
    if (place.column > 0) text += text_of(", column ", std::to_string(place.column));
    if (!place.heading.empty()) text += " (" + printable_text(place.heading, 60) + ")";
    text += ": " + printable_text(problem, 1000);
    if (!remedy.empty()) text += "; " + printable_text(remedy, 1000);
    return text;
}

SIVID_DECL std::string in_quotes(std::string_view text) {
    return "'" + printable_text(text, 40) + "'";
}

} // namespace sivid

#endif

// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_RESULT_IMPL_CERTIFICATES_CSV_IPP
#define SIVID_IO_RESULT_IMPL_CERTIFICATES_CSV_IPP

#include <sivid/io/result/certificates_csv.hpp>

#include <sivid/number/text/joined.hpp>

namespace sivid {

namespace io_detail {

constexpr std::array<std::string_view, 5> step_words{"run", "cut", "empty", "split", "leaf"};
constexpr auto certificate_headings = "step,of,end,at,weights";

template <class Number>
bool read_number(std::string_view& text, Number& value) {
    auto const [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return fault == std::errc{};
}
inline bool read_number(std::string_view& text, double& value) {
    auto const length = std::min(text.find_first_not_of("+-.0123456789eE"), text.size());
    auto const read = parse_nearest(text.substr(0, length));
    text.remove_prefix(length);
    value = read.value_or(0);
    return read.has_value();
}
inline bool take(std::string_view& text, char what) {
    bool const there = !text.empty() && text.front() == what;
    if (there) text.remove_prefix(1);
    return there;
}
/// @returns whether the text is made of weights
inline bool read_weights(std::string_view text, proof_step::groups& groups) {
    if (text.empty()) return true;
    do {
        auto& group = groups.emplace_back();
        do {
            auto& w = group.emplace_back();
            if (!read_number(text, w.experiment) || !take(text, ':') ||
                !read_number(text, w.output) || !take(text, ':') || !read_number(text, w.value)) {
                return false;
            }
        } while (take(text, ' '));
    } while (take(text, '|'));
    return text.empty();
}

} // namespace io_detail

SIVID_DECL std::string certificates_csv(exclusion_proof const& proof) {
    using kind = proof_step::kind;
    std::string text = io_detail::certificate_headings + std::string{"\n"};
    std::array<char, 40> buffer;
    auto const put = [&](double x, auto... precision) {
        auto const end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), x,
                                       std::chars_format::general, precision...)
                             .ptr;
        text.append(buffer.data(), end);
    };
    for (auto const& s : proof) {
        bool const cut = s.what == kind::cut, split = s.what == kind::split;
        text += io_detail::step_words[static_cast<std::size_t>(s.what)];
        text += ',';
        if (cut || split || s.what == kind::run) text += std::to_string(s.index);
        text += !cut ? "," : s.upper ? ",upper" : ",lower";
        text += ',';
        if (cut || split) put(s.at);
        text += ',';
        for (auto const& group : s.why) {
            if (&group != &s.why.front()) text += '|';
            for (auto const& w : group) {
                if (&w != &group.front()) text += ' ';
                text += std::to_string(w.experiment) + ":" + std::to_string(w.output) + ":";
                put(w.value, 9);
            }
        }
        text += '\n';
    }
    return text;
}

SIVID_DECL exclusion_proof read_certificates(csv_table const& table) {
    using kind = proof_step::kind;
    auto const remedy = "remove the file: the check then proves more by itself";
    if (joined(table.headings(), ",") != io_detail::certificate_headings) {
        table.fail(table.heading_line(),
                   std::string{"the columns are not "} + io_detail::certificate_headings, remedy);
    }
    exclusion_proof proof;
    for (auto const& row : table.rows()) {
        auto const bad = [&](std::size_t column) {
            table.fail(row.line, column, in_quotes(row.cells[column]) + " is no part of a proof",
                       remedy);
        };
        proof_step step;
        std::size_t k = 0;
        while (k < io_detail::step_words.size() && row.cells[0] != io_detail::step_words[k]) ++k;
        if (k == io_detail::step_words.size()) bad(0);
        step.what = static_cast<kind>(k);
        bool const cut = step.what == kind::cut, split = step.what == kind::split;
        auto const number = [&](std::size_t column, auto& value) {
            std::string_view text = row.cells[column];
            if (!io_detail::read_number(text, value) || !text.empty()) bad(column);
        };
        if (cut || split || step.what == kind::run) number(1, step.index);
        if (cut || split) number(3, step.at);
        step.upper = row.cells[2] == "upper";
        if (cut && !step.upper && row.cells[2] != "lower") bad(2);
        if (!std::isfinite(step.at)) bad(3);
        if (!io_detail::read_weights(row.cells[4], step.why)) bad(4);
        proof.push_back(std::move(step));
    }
    return proof;
}

} // namespace sivid

#endif

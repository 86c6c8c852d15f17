// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_STORED_PAGE_IPP
#define SIVID_REPORT_IMPL_STORED_PAGE_IPP

#include <sivid/report/stored_page.hpp>

#include <sivid/io/text/text_file.hpp>
#include <sivid/number/text/sha256.hpp>
#include <sivid/report/detail/stored_values.hpp>
#include <sivid/report/diagnosis_page.hpp>
#include <sivid/report/identification_page.hpp>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <tuple>

namespace sivid::report {

namespace detail {

template <class T>
struct unread {
    T value{};
};
template <>
struct unread<gain_set> {
    gain_set value{{}, {subpaving(box())}};
};
template <>
struct unread<subpaving> {
    subpaving value{box()};
};

/// The page that `make` makes of what is stored.
template <class... Shown>
stored_page made_by(stored_page (*make)(Shown const&...), value_reader const& in) {
    std::tuple<unread<Shown>...> all;
    return std::apply(
        [&](auto&... each) {
            in.list(each.value...);
            return make(each.value...);
        },
        all);
}

} // namespace detail

SIVID_DECL stored_page stored(identification_view const& v) {
    return detail::stored_as("identification", "report", identification_page(v), v);
}

SIVID_DECL stored_page stored(diagnosis_view const& v) {
    return detail::stored_as("diagnosis", "report", diagnosis_page(v), v);
}

SIVID_DECL stored_page confidence_page(std::string const& title, std::string const& probability,
                                       std::string const& reason, bool const& complete,
                                       std::vector<axis> const& sides, subpaving const& paving,
                                       std::vector<std::string> const& assumptions,
                                       std::vector<std::string> const& remarks,
                                       std::vector<std::string> const& footer) {
    named_paving named{.paving = &paving, .sides = sides};
    table hulls{columns("*unknown|#range|#prior|~unit")};
    for (std::size_t s = 0; s < sides.size(); ++s) {
        named.hull.push_back(paving.outer_hull()[s]);
        hulls.rows.push_back({sides[s].label, outward_text(paving.outer_hull()[s]),
                              outward_text(paving.prior()[s]), sides[s].unit});
    }
    page out(
        {"Confidence region", title, "Where the truth is with a probability of " + probability});
    out.banner(complete ? outcome::proved : outcome::undecided, probability,
               "For independent errors that are symmetric about zero, of any distribution and "
               "size. Inner and outer boxes are proved; " +
                   reason + ".");
    out.section("Ranges that hold the region").add(hulls).section("The region");
    out.add(detail::paving_figure(
        projections(named, {}, 6), "Projections of the region.", std::string(projection_rule),
        {.inside = "inside: proved in the region", .outside = "outside: proved not in it"}));
    out.assumptions(assumptions, "The probability rests on these assumptions");
    out.warnings(remarks).footer(footer);
    return detail::stored_as("confidence", "confidence", out, title, probability, reason, complete,
                             sides, paving, assumptions, remarks, footer);
}

namespace detail {

/// Both ends of each point, as lines: below the dashed one nothing explains, on the full one
/// something does; between points nothing is said.
inline svg curve_picture(size_curve const& curve) {
    range x{0, 0}, y{0, 0};
    for (auto const* line : {&curve.first, &curve.second})
        for (auto const& p : *line) {
            x.hi = std::max(x.hi, 1.1 * p.x);
            y.hi = std::max(y.hi, 1.1 * p.y);
        }
    axes const frame({"size of equations", "1", x}, {"size of channels", "1", y},
                     {.title = "Enough (full), not enough (dashed)"});
    svg out(360, 240, "trade-off of disturbances");
    frame.open(out);
    for (auto const* line : {&curve.first, &curve.second}) {
        path_data path;
        for (auto const& p : *line) {
            double const at = frame.px(p.x), on = frame.py(p.y);
            path.empty() ? path.move(at, on) : path.line(at, on);
            draw_estimate(out, at, on);
        }
        out.path(path, line == &curve.second ? line_after_paint : line_before_paint);
    }
    frame.close(out);
    return out;
}

} // namespace detail

SIVID_DECL stored_page disturbance_page(
    std::string const& title, std::vector<std::string> const& words, bool const& found,
    std::vector<std::pair<std::string, channel_series>> const& witness, size_curve const& curve,
    std::vector<std::string> const& assumptions, std::vector<std::string> const& footer) {
    page out({"Least disturbance", title,
              "How large unknown functions of time beside the model must be"});
    out.banner(found ? outcome::proved : outcome::undecided, words.empty() ? "" : words.front(),
               "Bounds hold for all measurable functions of time.");
    if (words.size() > 1) out.plain_words({words.begin() + 1, words.end()});
    figure all{.title = "What the witness is disturbed by.",
               .caption = "With it a validated run explains the data; others may do so."};
    for (auto const& [scenario, line] : witness)
        if (all.panels.size() < 12) all.panels.push_back(draw_time_plot(line, {.title = scenario}));
    if (!all.panels.empty()) out.section("Over time").add(all);
    if (!curve.first.empty())
        out.section("Equations against channels")
            .add(figure{.panels = {detail::curve_picture(curve)},
                        .title = "Sizes that are enough together.",
                        .caption = "Proved at the rings; lines only join them."});
    out.assumptions(assumptions).footer(footer);
    return detail::stored_as("disturbance", "disturbance", out, title, words, found, witness, curve,
                             assumptions, footer);
}

SIVID_DECL stored_page read_page(std::filesystem::path const& file) {
    auto const text = read_text(file);
    auto const json = read_json(file);
    if (json.at("format").string() != "sivid-page-1")
        json.fail("this is no page in the format sivid-page-1", "give a file *.page.json");
    auto const kind = json.at("page").string();
    auto const at = text.find(detail::before_shown);
    auto shown = at == std::string::npos ? std::string{} : text.substr(at);
    shown.erase(0, detail::before_shown.size());
    if (shown.ends_with("}\n")) shown.resize(shown.size() - 2);
    if (sha256(kind + "\n" + shown) != json.at("sha256").string())
        json.fail("the file was changed after it was written (SHA-256)",
                  "run the command again that wrote it");
    detail::value_reader const in(json.at("shows"));
    if (kind == "identification") return detail::made_by<identification_view>(stored, in);
    if (kind == "diagnosis") return detail::made_by<diagnosis_view>(stored, in);
    if (kind == "prediction") return detail::made_by(prediction_page, in);
    if (kind == "verification") return detail::made_by(verification_page, in);
    if (kind == "control") return detail::made_by(control_page, in);
    if (kind == "design") return detail::made_by(design_page, in);
    if (kind == "ranking") return detail::made_by(ranking_page, in);
    if (kind == "confidence") return detail::made_by(confidence_page, in);
    if (kind == "disturbance") return detail::made_by(disturbance_page, in);
    json.at("page").fail("unknown page " + in_quotes(kind),
                         "make it by the version that wrote the file");
}

} // namespace sivid::report

#endif

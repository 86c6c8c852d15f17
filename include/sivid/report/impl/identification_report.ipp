// SPDX-License-Identifier: MIT
#ifndef SIVID_REPORT_IMPL_IDENTIFICATION_REPORT_IPP
#define SIVID_REPORT_IMPL_IDENTIFICATION_REPORT_IPP

#include <sivid/report/identification_report.hpp>

#include <sivid/io/explaining_motion.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/number/text/joined.hpp>
#include <sivid/paving/excluded_between.hpp>
#include <sivid/paving/identification.hpp>
#include <sivid/report/detail/reach_words.hpp>
#include <sivid/report/draw/detail/paving_projections.hpp>
#include <sivid/report/fill/detail/scenario_report.hpp>
#include <sivid/report/identification_view.hpp>
#include <sivid/report/identification_words.hpp>
#include <sivid/report/words/detail/tried_words.hpp>
#include <sivid/version.hpp>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sivid::report {

namespace detail {

SIVID_DECL range shown_share(interval const& volume) {
    range const r = share_of_whole(volume);
    double const more = 5e-4 * r.hi;
    return r.lo == r.hi || r.hi - r.lo > more
               ? r
               : range{std::max(0.0, r.lo - more), std::min(1.0, r.hi + more)};
}

/// Fills the view of one identification step by step.
class report_filler {
public:
    report_filler(identification_problem const& problem, identification const& found,
                  explaining_motion const* motion, identification_report_options const& options)
        : problem_{problem}, found_{found}, motion_{motion}, options_{options} {}

    [[nodiscard]] identification_view view() {
        add_result();
        add_parameters();
        add_combinations();
        add_inside_box();
        add_witness();
        for (std::size_t e = 0; e < problem_.experiments.size(); ++e) {
            view_.scenarios.push_back(
                scenario_filler(problem_, found_, motion_, options_.plane, e, options_.keep_going)
                    .view());
        }
        add_marked();
        add_meanings();
        add_pavings();
        add_product_pavings();
        return std::move(view_);
    }

private:
    static constexpr std::size_t most_pavings = 6; ///< projections on pairs of parameters

    [[nodiscard]] model_description const& about() const { return problem_.model.about; }
    [[nodiscard]] std::vector<std::string> const& names() const { return problem_.choice.unknown; }
    [[nodiscard]] std::string unit_of(std::size_t j) const {
        return about().constants[index_of(about().constants, names()[j], "constant")].unit;
    }

    /// @param assumption  as `input_assumption` words it, with what is bridged after a semicolon
    [[nodiscard]] static std::string sentence_of(std::string const& assumption) {
        auto const end = std::min(assumption.find("; "), assumption.size());
        auto const bridged =
            end == assumption.size()
                ? std::string{}
                : " Samples are missing, and nobody knows what the input did there: " +
                      assumption.substr(end + 2) + ".";
        if (assumption.starts_with("inputs exact")) {
            return "The recorded inputs are exact, at their samples and in between as the data set "
                   "states." +
                   bridged;
        }
        if (assumption.starts_with("inputs within their stated errors")) {
            return "At every time the true inputs lie within their stated errors of the recorded "
                   "ones, in whatever way they vary there; inputs without a stated error are "
                   "exact." +
                   bridged;
        }
        return assumption;
    }

    void add_result() {
        view_.dataset = options_.dataset;
        view_.model = about().name;
        view_.time_unit = about().time_unit;
        view_.verdict = found_.verdict == verdict::consistent     ? outcome::proved
                        : found_.verdict == verdict::inconsistent ? outcome::refuted
                                                                  : outcome::undecided;
        view_.volume_inner = shown_share(found_.paving.inner_volume());
        view_.volume_outer = shown_share(found_.paving.outer_volume());
        view_.excluded = std::max(0.0, 1 - found_.paving.outer_volume().upper());
        for (std::string const& a : found_.assumptions) view_.assumptions.push_back(sentence_of(a));
        std::size_t budget = 0;
        for (experiment const& e : problem_.experiments) budget += e.outliers;
        view_.assumptions.push_back(
            budget == 0 ? "Every measurement lies within its stated bound of the true value."
                        : "Every measurement lies within its stated bound of the true value, but "
                          "for the outliers allowed.");
        view_.assumptions.push_back("The constants that are not listed as parameters have exactly "
                                    "their stated values.");
        for (auto& words : derivation_words(problem_.model, problem_.choice)) {
            view_.assumptions.push_back(std::move(words));
        }
        view_.assumptions.insert(view_.assumptions.end(), options_.further_assumptions.begin(),
                                 options_.further_assumptions.end());
        if (found_.fewest) {
            view_.proved.push_back(
                fewest_outliers_sentence(found_.fewest->total.least, found_.fewest->total.most));
        }
        view_.statistics = {found_.seconds, found_.boxes, found_.integrations,
                            std::string{to_string(found_.reason)}};
        view_.tried = tried_words(found_.journal);
        view_.statistics.why = reach_words(problem_, found_);
        view_.version = std::string{"sivid "} + std::string{version};
        view_.date = options_.date;
        view_.machine = options_.machine;
        view_.command = options_.command;
    }

    void add_parameters() {
        for (std::size_t j = 0; j < names().size(); ++j) {
            auto const meaning = options_.meanings.find(names()[j]);
            view_.parameters.push_back({names()[j], unit_of(j), problem_.prior[j], found_.hull[j],
                                        meaning == options_.meanings.end() ? "" : meaning->second,
                                        excluded_between(found_.paving, found_.hull, j)});
        }
    }

    void add_combinations() {
        std::vector<std::string> entangled;
        for (std::size_t const j : found_.entangled) entangled.push_back(names()[j]);
        for (combination_hull const& c : found_.combinations) {
            std::vector<std::string> members;
            for (std::size_t const j : found_.entangled) {
                if (c.what.exponents[j] != 0) members.push_back(names()[j]);
            }
            std::string note;
            if (members.size() > 1) {
                note = enumeration(members) + " are known only through " +
                       (found_.combinations.size() == 1 ? formula_text(c.what.formula)
                                                        : std::string{"such combinations"}) +
                       " on these data: the model's equations contain them in no other way, so "
                       "that no measurement can tell them apart.";
            }
            view_.combinations.push_back(
                {c.what.formula, c.what.unit, c.hull, c.what.over(problem_.prior), note});
        }
    }

    /// In products where the search ran there.
    void add_inside_box() {
        auto const* const products = found_.products ? &*found_.products : nullptr;
        auto const* const box =
            (products ? products->paving : found_.paving).largest(box_verdict::inside);
        if (box == nullptr) return;
        std::vector<std::string> sides;
        for (std::size_t k = 0; k < box->size(); ++k) {
            auto const* const side = products ? &products->map.sides()[k] : nullptr;
            std::size_t const j = side ? side->parameter : k;
            bool const product = side && side->product;
            auto const range = inward_text((*box)[k]);
            if (!range) return;
            std::string const unit = unit_text(product ? side->product->unit : unit_of(j));
            sides.push_back((product ? formula_text(side->product->formula) : names()[j]) + " in " +
                            *range + (unit.empty() ? "" : " " + unit));
        }
        view_.inside_box = enumeration(sides);
    }

    void add_witness() {
        if (!found_.witness) return;
        named_witness w;
        for (std::size_t j = 0; j < names().size(); ++j) {
            w.parameters.push_back({names()[j], unit_of(j), found_.witness->parameters[j]});
        }
        for (std::size_t e = 0; e < problem_.experiments.size(); ++e) {
            named_witness::start start{problem_.experiments[e].name, {}};
            for (std::size_t i = 0; i < about().states.size(); ++i) {
                start.states.push_back(
                    {about().states[i].name, about().states[i].unit, found_.witness->starts[e][i]});
            }
            w.starts.push_back(std::move(start));
        }
        view_.witness = std::move(w);
    }

    void add_marked() {
        for (scenario_view const& s : view_.scenarios) {
            for (channel_series const& c : s.channels) {
                for (measured_sample const& m : c.measured) {
                    if (m.state != sample_state::regular) {
                        view_.outliers.push_back(
                            {s.name, c.name, m.time, m.state == sample_state::forced_outlier});
                    }
                }
            }
        }
        for (std::size_t e = 0; motion_ != nullptr && e < problem_.experiments.size(); ++e) {
            if (auto const& why = motion_->tubes[e]->failure()) {
                view_.warnings.push_back(
                    std::string{"The drawn enclosure of scenario "} + problem_.experiments[e].name +
                    " ends early: " +
                    why->message(about().states[why->component].name, about().time_unit) + ".");
            }
        }
    }

    void add_meanings() {
        if (found_.witness) {
            view_.reference_meaning = "plain numeric integration at the witness";
        } else if (found_.guess) {
            view_.reference_meaning = "plain numeric integration at the best fit found, about "
                                      "which nothing is proved";
        }
        if (motion_ == nullptr) return;
        if (motion_->source == motion_source::best_guess) {
            view_.tube_meaning = "the motion of the best fit found, which is not proved to explain "
                                 "the data";
            return;
        }
        if (motion_->source == motion_source::witness) {
            view_.tube_meaning = "the motion of the witness";
            return;
        }
        std::string box_text;
        for (std::size_t j = 0; j < names().size(); ++j) {
            box_text += (j == 0 ? "" : ", ") + names()[j] + " in " +
                        outward_text(motion_->parameters[j]) + unit_suffix(unit_of(j));
        }
        view_.tube_meaning =
            std::string{"all motions of a box of parameters that is proved to explain the "
                        "data, about "} +
            box_text;
    }

    /// Those of parameters that are known only through a combination come first.
    void add_pavings() {
        named_paving p{.paving = &found_.paving};
        for (std::size_t j = 0; j < names().size(); ++j) {
            p.sides.push_back({names()[j], unit_of(j), problem_.prior[j]});
            p.hull.push_back(view_.parameters[j].hull);
        }
        if (found_.witness) p.witness = found_.witness->parameters;
        view_.pavings = projections(p, found_.entangled, most_pavings);
    }

    void add_product_pavings() {
        if (!found_.products) return;
        auto const& map = found_.products->map;
        named_paving p{.paving = &found_.products->paving};
        auto const hull = map.forward(found_.hull);
        std::vector<std::size_t> products;
        for (std::size_t k = 0; k < map.sides().size(); ++k) {
            auto const& side = map.sides()[k];
            p.sides.push_back(
                {side.product ? formula_text(side.product->formula) : names()[side.parameter],
                 side.product ? side.product->unit : unit_of(side.parameter),
                 map.problem().prior[k]});
            p.hull.push_back(hull[k]);
            if (side.product) products.push_back(k);
        }
        if (found_.witness) p.witness = mid(map.forward(point_box(found_.witness->parameters)));
        view_.product_pavings = projections(p, products, most_pavings);
    }

    identification_problem const& problem_;
    identification const& found_;
    explaining_motion const* motion_;
    identification_report_options const& options_;
    identification_view view_;
};

} // namespace detail

SIVID_DECL identification_view view_of(identification_problem const& problem,
                                       identification const& found, explaining_motion const* motion,
                                       identification_report_options const& options) {
    return detail::report_filler(problem, found, motion, options).view();
}

SIVID_DECL comparison_row comparison_of(std::string name, identification const& found, bool chosen,
                                        std::string note) {
    return {std::move(name),
            found.seconds,
            found.boxes,
            found.integrations,
            detail::shown_share(found.paving.inner_volume()),
            detail::shown_share(found.paving.outer_volume()),
            std::move(note),
            chosen};
}

} // namespace sivid::report

#endif

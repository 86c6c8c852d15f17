// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_IDENTIFICATION_CHECK_WORK_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_IDENTIFICATION_CHECK_WORK_HPP

#include <sivid/io/explaining_motion.hpp>
#include <sivid/io/identification_csv.hpp>
#include <sivid/io/result/stored_identification.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identifiability.hpp>
#include <sivid/paving/identifiability/detail/output_sensitivities.hpp>
#include <sivid/paving/judge/witness.hpp>
#include <sivid/paving/outlier_budget.hpp>
#include <sivid/paving/strategy/detail/completion.hpp>
#include <sivid/space/box.hpp>
#include <sivid/verifier/check_finding.hpp>
#include <sivid/verifier/claim/detail/named_motion.hpp>
#include <sivid/verifier/claim/detail/paving_check.hpp>
#include <sivid/verifier/claim/detail/restated.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Whether boxes contradict the reason to stop: nothing is left to decide, or nothing waits, or all
/// waits. Whether time, memory or somebody ended a search leaves no trace.
[[nodiscard]] inline check_finding check_stop(stored_identification const& stored) {
    using outcome = check_finding::outcome;
    auto const& rows = stored.products ? stored.products->rows : stored.rows;
    auto const count = [&rows](box_verdict v) {
        return std::ranges::count(rows, v, &paved_box::verdict);
    };
    bool const pending = count(box_verdict::pending) > 0;
    bool const undecided = count(box_verdict::undecided) > 0;
    auto const r = stored.reason;
    bool holds = (r == stop_reason::decided) == !(pending || undecided);
    if (stored.searched && r != stop_reason::decided)
        holds = holds && pending == (r != stop_reason::accuracy_reached);
    // The search has decided nothing; the box about the witness came behind it.
    if (r == stop_reason::too_blurred)
        holds = holds && !undecided && count(box_verdict::inside) <= 1;
    auto const words = "'" + std::string{to_string(r)} + "'";
    if (!holds) return {"reason to stop", outcome::refuted, words + " contradicts the boxes"};
    if (r == stop_reason::decided || r == stop_reason::accuracy_reached)
        return {"reason to stop", outcome::verified, words + ", given the boxes"};
    return {"reason to stop", outcome::nothing, words + " leaves no trace"};
}

/// Whether so many outliers are needed as a result says: the search for the fewest once more.
///   That they suffice is the verdict with these budgets.
[[nodiscard]] inline check_finding check_fewest(identification_problem const& problem,
                                                stored_identification const& stored, double seconds,
                                                std::function<bool()> const& keep_going = nullptr) {
    using outcome = check_finding::outcome;
    std::string const what = "outliers needed";
    if (!stored.fewest) return {what, outcome::nothing, ""};
    std::size_t budgets = 0;
    bool fit = stored.verdict == verdict::consistent &&
               stored.fewest_alone.size() == problem.experiments.size();
    for (auto const& e : problem.experiments) {
        auto const own = stored.fewest_alone.find(e.name);
        fit = fit && own != stored.fewest_alone.end() && own->second.most <= e.outliers &&
              e.outliers <= e.measurements.size();
        budgets += e.outliers;
    }
    if (!fit || stored.fewest->most != budgets)
        return {what, outcome::refuted, "they do not fit the verdict and the scenarios' budgets"};
    outlier_search_options how;
    how.seconds = seconds;
    how.keep_going = keep_going;
    auto const found = smallest_outlier_budget(problem, how);
    auto result = outcome::verified;
    std::string why = "searched once more";
    auto const compare = [&](proved_count const& stated, proved_count const& again,
                             std::string const& of) {
        bool const apart = stated.least > again.most || stated.most < again.least;
        bool const within = stated.least <= again.least && again.most <= stated.most;
        if (within || result == outcome::refuted) return;
        result = apart ? outcome::refuted : outcome::undecided;
        why = of + ": " + std::to_string(again.least) + " to " + std::to_string(again.most) +
              (apart ? " are needed" : ", no more is proved within the budget");
    };
    auto total = found.total; // what the verdict shows
    total.most = std::min(total.most, std::max(budgets, total.least));
    compare(*stored.fewest, total, "in all");
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        auto const& name = problem.experiments[e].name;
        auto alone = found.alone[e];
        alone.most = std::min(alone.most, std::max(problem.experiments[e].outliers, alone.least));
        compare(stored.fewest_alone.at(name), alone, name);
    }
    return {what, result, why};
}

namespace io_detail {

/// Forced outliers as their function finds them, those that are stated; a result names them by
/// instant and channel, not which of several readings.
/// @param found    receives those that are stated and found once more
/// @param witness  as verified; null where it is not
[[nodiscard]] inline check_finding check_forced(identification_problem const& problem,
                                                stored_identification const& stored,
                                                std::vector<forced_outlier> const& again,
                                                verified_witness const* witness,
                                                std::vector<forced_outlier>& found) {
    using outcome = check_finding::outcome;
    using place = std::pair<double, std::string>;
    std::string const what = "proved outliers";
    auto const& channels = problem.model.about.channels;
    std::size_t known = 0;
    bool all = true;
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        auto const& own = problem.experiments[e];
        std::map<place, std::size_t> stated;
        for (auto const& f : stored.forced)
            if (f.scenario == own.name) ++stated[{f.time, f.channel}];
        for (auto const& [where, count] : stated) known += count;
        auto missed = stated; // how many more the witness would have to miss
        auto const samples = sorted(own.measurements);
        for (std::size_t k = 0; k < samples.size(); ++k) {
            place const where{samples[k].time, channels[samples[k].channel].name};
            auto const needed = missed.find(where);
            if (needed == missed.end()) continue;
            bool const met = witness != nullptr && !witness->violated[e][k];
            if (!met && needed->second > 0) --needed->second;
            bool const forced = std::ranges::any_of(
                again, [&](auto const& f) { return f.experiment == e && f.measurement == k; });
            if (!forced || stated[where] == 0) continue;
            --stated[where];
            found.push_back({e, k});
        }
        for (auto const& [where, count] : missed)
            if (count > 0)
                return {what, outcome::refuted,
                        "no such measurement in " + own.name + ", or the witness meets it"};
        all = all && std::ranges::all_of(stated, [](auto const& s) { return s.second == 0; });
    }
    if (known < stored.forced.size())
        return {what, outcome::refuted, "one in no scenario of the data set"};
    if (known == 0) return {what, outcome::nothing, ""};
    if (!all) return {what, outcome::undecided, "not all of them are found once more"};
    return {what, outcome::verified, "all that is left violates them"};
}

/// The outputs of the motion that outputs.csv is said to be of, enclosed once more as its writer
/// did. Cells that state no range where one is known state less, and nothing false.
/// @param fault  receives why there is no such motion
[[nodiscard]] inline std::optional<explaining_motion>
shown_once_more(identification_problem const& problem, stored_identification const& stored,
                std::function<bool()> const& keep_going, std::string& fault) {
    auto const& shown = *stored.shown;
    auto const at = motion_by_names(problem, shown.parameters, shown.initial, fault);
    if (!at) return std::nullopt;
    auto const same = [](box const& a, box const& b) { return subset(a, b) && subset(b, a); };
    auto source = motion_source::best_guess;
    if (shown.source == to_string(motion_source::witness)) {
        source = motion_source::witness;
        auto const w = stored.witness ? witness_motion(problem, stored, fault) : std::nullopt;
        if (!w || !same(w->parameters, at->parameters) ||
            !std::ranges::equal(w->starts, at->starts, same))
            fault = "its parameters are not the witness's";
    } else if (shown.source == to_string(motion_source::inside_box)) {
        source = motion_source::inside_box;
        bool const is_inside = std::ranges::any_of(stored.rows, [&](paved_box const& row) {
            return row.verdict == box_verdict::inside && subset(at->parameters, row.set);
        });
        if (!is_inside) fault = "its parameters lie in no inside box";
    }
    if (!fault.empty()) return std::nullopt;
    return enclose_motion(problem, source, at->parameters, at->starts, motion_pieces, keep_going);
}

/// The lines of a table, each from the other one where that states less.
[[nodiscard]] inline std::string with_blanks(std::string const& full, std::string const& blank,
                                             std::string const& stated) {
    std::istringstream first(full), second(blank), third(stated);
    std::string text, whole, less, said;
    while (std::getline(first, whole) && std::getline(second, less)) {
        std::getline(third, said);
        text += (said == less ? less : whole) + "\n";
    }
    return text;
}

/// One check of a stored identification.
template <class Exact, class Fast>
class identification_check_work {
public:
    identification_check_work(identification_problem const& problem,
                              stored_identification const& stored,
                              identification_check_options const& options)
        : problem_(&problem),
          stored_(&stored),
          options_(options),
          limit_(options.seconds, options.certificate.keep_going),
          again_(restate(problem, stored)) {
        options_.certificate.keep_going = options_.run.keep_going = limit_;
        // Finer than the search: what it cut off must be cut off again.
        auto& fine = options_.run;
        double const stated = stored.tolerance > 0 ? stored.tolerance : fine.tolerance;
        fine.tolerance = std::clamp(0.01 * stated, 1e-11, fine.tolerance);
        fine.relative_tolerance = std::min(fine.relative_tolerance, 1e3 * fine.tolerance);
    }

    /// All findings, each handed to `tell` as soon as it is there.
    std::vector<check_finding> operator()(std::function<void(check_finding const&)> const& tell) {
        findings all{tell, {}};
        if (!again_.fault.empty()) {
            all.add([&] { return check_finding{"products", outcome::refuted, again_.fault}; });
            return all.done;
        }
        all.add([&] { return check_stop(*stored_); });
        all.add([&] { return witness(); });
        all.add([&] { return forced(); });
        all.add([&] { return check_fewest(*problem_, *stored_, 0.2 * limit_.seconds(), limit_); });
        check_members(all);
        check_boxes(all);
        if (again_.map) check_product_boxes(all);
        return all.done;
    }

private:
    using outcome = check_finding::outcome;

    /// Findings with the time that each took.
    struct findings {
        std::function<void(check_finding const&)> const& tell;
        std::vector<check_finding> done;

        void add(auto const& work) {
            stopwatch const clock;
            done.push_back(work());
            done.back().seconds = clock.spent();
            if (tell) tell(done.back());
        }
    };

    /// Each of what takes long gets a share of the time that is left.
    void spend_at_most(double share) { options_.seconds = share * limit_.seconds(); }

    /// What follows from boxes, witness and problem.
    void check_members(findings& all) {
        identification_json_options json;
        json.further_assumptions = options_.further_assumptions;
        std::optional<explaining_motion> motion;
        std::optional<identifiability> told;
        std::string text;
        std::map<std::string, std::string> follows;
        all.add([&] {
            if (stored_->identifiable_at) told = identifiability_again();
            json.identifiability = told ? &*told : nullptr;
            check_finding outputs{"outputs", outcome::nothing, ""};
            if (stored_->shown) {
                outputs = outputs_once_more(motion, text);
                json.outputs = &text;
                json.motion = motion ? &*motion : nullptr;
            } else if (!stored_->outputs.empty()) {
                outputs = {"outputs", outcome::undecided,
                           "the result does not say of which motion outputs.csv is"};
            }
            follows = members_of(*problem_, again_.found, json);
            auto stated = compared("outputs", {"outputs"}, stored_->stated, follows);
            bool const differs = stated.found != outcome::verified; // the digest, or of what it is
            return outputs.found == outcome::verified && differs ? stated : outputs;
        });
        for (auto& found : compared_groups(*stored_, again_, follows))
            all.add([&] { return std::move(found); });
        all.add([&] {
            auto found = compared("identifiability", {"identifiability"}, stored_->stated, follows);
            if (found.found == outcome::refuted && !limit_())
                found = {found.what, outcome::undecided, "not within the budget"};
            return found;
        });
    }
    /// Where the result says; nothing where it does not say where.
    [[nodiscard]] std::optional<identifiability> identifiability_again() const {
        identifiability_options options;
        options.enclosure.keep_going = limit_;
        auto at = problem_->prior;
        for (auto const& e : problem_->experiments) options.at_starts.push_back(e.initial);
        for (auto const& q : unknowns_of(*problem_, true)) {
            auto const own = stored_->identifiable_at->find(q.name);
            if (own == stored_->identifiable_at->end()) return std::nullopt;
            (q.experiment ? options.at_starts[*q.experiment] : at)[q.index] = own->second;
        }
        return identifiability_of(*problem_, at, options);
    }
    /// @param text  receives outputs.csv as it should be
    [[nodiscard]] check_finding outputs_once_more(std::optional<explaining_motion>& motion,
                                                  std::string& text) {
        std::string fault;
        if (!stored_->shown->source.empty()) {
            motion = shown_once_more(*problem_, *stored_, limit_, fault);
            if (!motion)
                return {"outputs", outcome::refuted, "the motion of outputs.csv: " + fault};
        }
        auto told = again_.found;
        told.witness.reset();
        if (verified_) told.witness = *verified_;
        auto const blank = outputs_csv(*problem_, told, nullptr);
        text = with_blanks(outputs_csv(*problem_, told, motion ? &*motion : nullptr), blank,
                           stored_->outputs);
        if (!limit_()) return {"outputs", outcome::undecided, "not within the budget"};
        if (stored_->witness && !verified_)
            return {"outputs", outcome::undecided, "no proof which the witness meets"};
        if (text != stored_->outputs)
            return {"outputs", outcome::refuted,
                    "outputs.csv is not that of the " + stored_->shown->source +
                        ", enclosed again"};
        return {"outputs", outcome::verified, "those of the " + stored_->shown->source};
    }

    /// The boxes of boxes.csv and what they leave out; from the products where there are such.
    void check_boxes(findings& all) {
        auto const& rows = stored_->rows;
        paving_check<Fast> boxes(*problem_, problem_->choice.unknown, rows, starts_, options_,
                                 again_.map ? exclusion_proof{} : stored_->proof);
        all.add([&] { return boxes.covering("cover"); });
        if (!again_.map) {
            all.add([&] {
                spend_at_most(0.5);
                return boxes.inside("inside boxes");
            });
            all.add([&] {
                spend_at_most(1.0);
                return boxes.outside("excluded boxes");
            });
            return;
        }
        auto products = paving_of(again_.map->problem().prior, stored_->products->rows);
        std::vector<box> sets;
        for (auto const& row : products.boxes()) sets.push_back(row.set);
        for (auto& gap : cover(products.prior(), sets).gaps)
            products.add(std::move(gap), box_verdict::outside);
        drawing_check drawn(*again_.map, products, problem_->prior, limit_);
        all.add([&] { return drawn.inside("inside boxes", rows); });
        all.add([&] { return drawn.excluded("excluded boxes", rows, boxes.gaps()); });
    }

    /// The same of products.csv.
    void check_product_boxes(findings& all) {
        paving_check<Fast> products(again_.map->problem(), stored_->products->sides,
                                    stored_->products->rows, starts_, options_, stored_->proof);
        all.add([&] { return products.covering("product cover"); });
        all.add([&] {
            spend_at_most(0.5);
            return products.inside("inside products");
        });
        all.add([&] {
            spend_at_most(1.0);
            return products.outside("excluded products");
        });
    }

    [[nodiscard]] check_finding witness() {
        std::string fault;
        if (!stored_->witness) return {"witness", outcome::nothing, fault};
        auto const w = witness_motion(*problem_, *stored_, fault);
        if (!w) return {"witness", outcome::refuted, "the witness: " + fault};
        auto alone = *problem_; // from the starts of the witness
        for (std::size_t e = 0; e < w->starts.size(); ++e)
            alone.experiments[e].initial = w->starts[e];
        enclosure_options fine{
            .order = 14, .tolerance = 1e-11, .relative_tolerance = 1e-3, .minimum_step = 1e-7};
        fine.keep_going = limit_;
        proved_campaign<Exact> campaign(alone, {}, fine);
        auto const known = campaign.learn(w->parameters);
        auto const says = campaign.judge(known, w->parameters);
        if (says == run_finding::refuted)
            return {"witness", outcome::refuted,
                    "it does not explain " + alone.experiments[known.all.size() - 1].name};
        if (says == run_finding::open)
            return {"witness", outcome::undecided, "no proof that it explains the data"};
        starts_ = w->starts;
        feasibility_test test(*problem_, limited({}, limit_));
        std::vector<std::vector<double>> starts;
        for (auto const& start : w->starts) starts.push_back(mid(start));
        verified_ = verify_witness(test, *problem_, mid(w->parameters), starts);
        std::size_t samples = 0;
        for (auto const& e : alone.experiments) samples += e.measurements.size();
        return {"witness", outcome::verified,
                "explains " + std::to_string(samples) + " measurements by " +
                    std::to_string(starts_.size()) + " validated runs"};
    }

    [[nodiscard]] check_finding forced() {
        std::vector<forced_outlier> again;
        auto const& searched = again_.map ? again_.map->problem() : *problem_;
        auto const& paving = again_.map ? again_.found.products->paving : again_.found.paving;
        if (!stored_->forced.empty() && paving.has_outer()) {
            feasibility_test test(searched, limited({}, limit_));
            again = paving_detail::find_forced(test, searched, paving.outer_hull());
        }
        return check_forced(*problem_, *stored_, again, verified_ ? &*verified_ : nullptr,
                            again_.found.forced);
    }

    identification_problem const* problem_;
    stored_identification const* stored_;
    identification_check_options options_; ///< its `seconds` are those of the step at hand
    work_limit limit_;
    restated again_;
    std::vector<box> starts_;                  ///< of a verified witness
    std::optional<verified_witness> verified_; ///< with what it meets, where that is known
};

} // namespace io_detail

} // namespace sivid

#endif

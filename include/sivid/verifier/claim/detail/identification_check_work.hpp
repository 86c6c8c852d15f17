// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_IDENTIFICATION_CHECK_WORK_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_IDENTIFICATION_CHECK_WORK_HPP

#include <sivid/io/result/stored_identification.hpp>
#include <sivid/model/problem.hpp>
#include <sivid/paving/identifiability.hpp>
#include <sivid/paving/identifiability/detail/output_sensitivities.hpp>
#include <sivid/space/box.hpp>
#include <sivid/verifier/check_finding.hpp>
#include <sivid/verifier/claim/detail/named_motion.hpp>
#include <sivid/verifier/claim/detail/paving_check.hpp>
#include <sivid/verifier/claim/detail/stored_claims.hpp>
#include <sivid/verifier/claim/detail/witness_checks.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// What of it is called proved.
[[nodiscard]] inline stored_identification::identifiability_claims
claims_of(identifiability const& found) {
    stored_identification::identifiability_claims result;
    for (auto const& q : found.unknowns) {
        result.unknowns.push_back(q.name);
        result.at[q.name] =
            q.experiment ? found.starts[*q.experiment][q.index] : found.parameters[q.index];
    }
    result.least_rank = found.least_rank;
    result.most_rank = found.most_rank;
    for (auto const& m : found.free) {
        if (!m.proved) continue;
        std::map<std::string, long> weights;
        for (std::size_t c = 0; c < m.weights.size(); ++c) {
            if (m.weights[c] != 0) weights[found.unknowns[c].name] = m.weights[c];
        }
        result.proved.push_back(io_detail::motion_claim(
            m.kind == motion_kind::scaling ? "scaling" : "translation", weights));
    }
    for (auto const& f : found.fixed)
        if (f.proved) result.proved.push_back("fixed " + f.formula);
    return result;
}

/// Ranks, motions and formulas that a result calls proved, computed anew from the equations.
/// @param keep_going  once false, what is not computed by then is not decided
[[nodiscard]] inline check_finding
check_identifiability(identification_problem const& problem, stored_identification const& stored,
                      std::function<bool()> const& keep_going = nullptr) {
    using outcome = check_finding::outcome;
    std::string const what = "identifiability";
    if (!stored.identifiability) return {what, outcome::nothing, ""};
    auto const& said = *stored.identifiability;
    identifiability_options options;
    options.enclosure.keep_going = keep_going;
    auto at = problem.prior;
    for (auto const& e : problem.experiments) options.at_starts.push_back(e.initial);
    for (auto const& q : unknowns_of(problem, true)) {
        auto const own = said.at.find(q.name);
        if (own == said.at.end())
            return {what, outcome::undecided, "for which " + q.name + " is not stated"};
        (q.experiment ? options.at_starts[*q.experiment] : at)[q.index] = own->second;
    }
    auto const found = claims_of(identifiability_of(problem, at, options));
    if (said.unknowns != found.unknowns)
        return {what, outcome::refuted, "other unknowns than those of the problem"};
    if (said.least_rank > found.most_rank || said.most_rank < found.least_rank)
        return {what, outcome::refuted,
                "the rank is " + std::to_string(found.least_rank) + " to " +
                    std::to_string(found.most_rank)};
    if (said.least_rank > found.least_rank || said.most_rank < found.most_rank)
        return {what, outcome::undecided, "the rank is not proved anew"};
    for (auto const& claim : said.proved) {
        if (std::find(found.proved.begin(), found.proved.end(), claim) == found.proved.end())
            return {what, outcome::undecided, "not proved anew: " + claim};
    }
    return {what, outcome::verified,
            "rank and " + std::to_string(said.proved.size()) + " formulas and motions, anew"};
}

namespace io_detail {

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
          limit_(options.seconds, options.certificate.keep_going) {
        auto& how = options_.certificate;
        how.keep_going = options_.run.keep_going = limit_;
    }

    /// All findings, each handed to `tell` as soon as it is there.
    std::vector<check_finding> operator()(std::function<void(check_finding const&)> const& tell) {
        findings all{tell, {}};
        refine_runs();
        if (by_products()) {
            rebuilt_ = rebuild_products<Exact>(*problem_, stored_->products->sides);
            all.add([&] { return check_products(rebuilt_, *stored_->products); });
            if (!rebuilt_.malformed.empty()) return all.done;
        }
        check_statements(all);
        check_motions(all);
        if (by_products()) all.add([&] { return check_rows(*problem_, *stored_); });
        check_boxes(all);
        if (drawn()) check_product_boxes(all);
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

    [[nodiscard]] bool by_products() const { return stored_->products.has_value(); }
    /// Whether the boxes are drawn from those of products.
    [[nodiscard]] bool drawn() const { return by_products() && rebuilt_.unproved.empty(); }
    /// Each of what takes long gets a share of the time that is left.
    void spend_at_most(double share) { options_.seconds = share * limit_.seconds(); }

    /// Finer than the search: what it cut off must be cut off again.
    void refine_runs() {
        auto& fine = options_.run;
        double const stated = stored_->tolerance > 0 ? stored_->tolerance : fine.tolerance;
        fine.tolerance = std::clamp(0.01 * stated, 1e-11, fine.tolerance);
        fine.relative_tolerance = std::min(fine.relative_tolerance, 1e3 * fine.tolerance);
    }

    /// What follows from the files and the problem alone.
    void check_statements(findings& all) {
        auto const& prior = by_products() ? rebuilt_.problem.prior : problem_->prior;
        all.add([&] { return check_files(*stored_); });
        all.add([&] { return check_problem(*problem_, *stored_); });
        all.add(
            [&] { return check_assumptions(*problem_, *stored_, options_.further_assumptions); });
        all.add([&] { return check_stop(*stored_, prior); });
        if (by_products()) {
            all.add([&] { return check_verdict_of_products(*problem_, *stored_, limit_); });
            all.add([&] { return check_hull_of_products<Exact>(*problem_, *stored_, rebuilt_); });
            all.add([&] { return check_volumes_of_products(*problem_, *stored_, limit_); });
            all.add([&] { return check_combinations_of_products(*stored_); });
        } else {
            all.add([&] { return check_verdict(*stored_); });
            all.add([&] { return check_hull(*problem_, *stored_); });
            all.add([&] { return check_volumes(*problem_, *stored_); });
            all.add([&] { return check_combinations<Exact>(*problem_, *stored_); });
        }
    }

    /// What is said of single motions, of outliers and of what data can tell.
    void check_motions(findings& all) {
        all.add([&] { return witness(); });
        all.add([&] {
            return check_forced<Fast>(*problem_, *stored_, readings_.met, options_.certificate,
                                      0.2 * limit_.seconds());
        });
        all.add([&] {
            auto how = options_.certificate;
            if (options_.all) how.runs_per_claim = static_cast<std::size_t>(-1);
            return check_fewest<Fast>(*problem_, *stored_, how, 0.2 * limit_.seconds(),
                                      options_.all ? 0 : std::max<std::size_t>(options_.sample, 1),
                                      options_.seed + 2);
        });
        all.add([&] { return check_identifiability(*problem_, *stored_, limit_); });
        all.add([&] {
            return check_outputs<Exact, Fast>(*problem_, *stored_, readings_, of_points(),
                                              0.2 * limit_.seconds());
        });
    }

    /// The boxes of boxes.csv and what they leave out; from the products where these tell it.
    void check_boxes(findings& all) {
        paving_check<Fast> boxes(*problem_, problem_->choice.unknown, stored_->rows, starts_,
                                 options_, by_products() ? exclusion_proof{} : stored_->proof);
        all.add([&] { return boxes.covering("cover"); });
        std::optional<drawing_check<Exact>> drawing;
        if (drawn()) drawing.emplace(*problem_, *stored_, rebuilt_, 400'000, limit_);
        all.add([&] {
            std::string const what = "inside boxes";
            spend_at_most(drawing ? 0.25 : 0.5);
            if (!drawing) return boxes.inside(what);
            auto found = drawing->inside(what);
            return found.found == outcome::undecided ? boxes.inside(what) : found;
        });
        all.add([&] {
            std::string const what = "excluded boxes";
            spend_at_most(drawing ? 0.25 : 1.0);
            if (!drawing || !boxes.covered()) return boxes.outside(what);
            auto found = drawing->excluded(what, boxes.gaps());
            return found.found == outcome::undecided ? boxes.outside(what) : found;
        });
    }

    /// The same of products.csv.
    void check_product_boxes(findings& all) {
        paving_check<Fast> products(rebuilt_.problem, stored_->products->sides,
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

    /// How single points are followed.
    [[nodiscard]] enclosure_options of_points() const {
        enclosure_options fine{
            .order = 14, .tolerance = 1e-11, .relative_tolerance = 1e-3, .minimum_step = 1e-7};
        fine.keep_going = limit_;
        return fine;
    }

    [[nodiscard]] check_finding witness() {
        std::string fault;
        if (!stored_->witness) return {"witness", outcome::nothing, fault};
        auto const w = witness_motion(*problem_, *stored_, fault);
        if (!w) return {"witness", outcome::refuted, "the witness: " + fault};
        auto alone = *problem_; // from the starts of the witness
        for (std::size_t e = 0; e < w->starts.size(); ++e)
            alone.experiments[e].initial = w->starts[e];
        proved_campaign<Exact> campaign(alone, {}, of_points());
        auto const known = campaign.learn(w->parameters, false);
        std::size_t samples = 0;
        for (std::size_t e = 0; e < known.all.size(); ++e) {
            auto const& own = alone.experiments[e]; // by recorded inputs: any possible ones will do
            note_readings(e, any_uncertain(own.inputs) ? known.chosen[e] : known.all[e],
                          sorted(own.measurements));
            samples += own.measurements.size();
        }
        auto const says = campaign.judge(known, w->parameters);
        if (says == run_finding::refuted)
            return {"witness", outcome::refuted,
                    "it does not explain " + alone.experiments[known.all.size() - 1].name};
        if (says == run_finding::open)
            return {"witness", outcome::undecided, "no proof that it explains the data"};
        starts_ = w->starts;
        return {"witness", outcome::verified,
                "explains " + std::to_string(samples) + " measurements by " +
                    std::to_string(starts_.size()) + " validated runs"};
    }
    /// What the witness certainly meets cannot be a forced outlier.
    void note_readings(std::size_t e, plain_outputs<Exact> const& known, record const& samples) {
        for (std::size_t k = 0; k < samples.size(); ++k) {
            bool const there = k < known.outputs.size() && known.outputs[k].defined;
            readings_.note(e, samples[k].bound,
                           there ? std::optional{known.outputs[k].value} : std::nullopt);
        }
    }

    identification_problem const* problem_;
    stored_identification const* stored_;
    identification_check_options options_; ///< its `seconds` are those of the step at hand
    work_limit limit_;
    stored_products rebuilt_;   ///< where it has products
    std::vector<box> starts_;   ///< of a verified witness
    witness_readings readings_; ///< of the witness
};

} // namespace io_detail

} // namespace sivid

#endif

// SPDX-License-Identifier: MIT
#ifndef SIVID_IO_IDENTIFICATION_CHECK_HPP
#define SIVID_IO_IDENTIFICATION_CHECK_HPP

#include <sivid/io/forced_outlier_check.hpp>
#include <sivid/io/identification_consistency.hpp>
#include <sivid/paving/certificate.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

struct identification_check_options {
    std::size_t sample = 24; ///< so many inside and so many excluded boxes, or parts of them
    bool all = false;        ///< every box instead
    std::uint64_t seed = 1;
    double seconds = 10; ///< for the inside boxes, and as much for the excluded ones
    certificate_options certificate;
};

/// Checks a stored identification against its problem, from nothing but the model and the data.
/// @tparam Exact  interval type of the runs at the witness (mp_interval: 40 digits)
/// @tparam Fast   interval type of the runs over boxes
template <class Exact, class Fast>
class identification_check {
public:
    /// @given  `require_same_problem`; the problem has the outlier budgets of the result
    identification_check(identification_problem const& problem, stored_identification const& stored,
                         identification_check_options options)
        : problem_(&problem), stored_(&stored), options_(std::move(options)) {}

    /// All findings, each handed to `tell` as soon as it is there.
    std::vector<check_finding>
    operator()(std::function<void(check_finding const&)> const& tell = nullptr) {
        std::vector<check_finding> all;
        auto const add = [&](auto const& work) {
            auto const begin = std::chrono::steady_clock::now();
            all.push_back(work());
            all.back().seconds =
                std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
            if (tell) tell(all.back());
        };
        add([&] { return check_verdict(*stored_); });
        add([&] { return check_hull(*problem_, *stored_); });
        add([&] { return check_volumes(*problem_, *stored_); });
        add([&] { return check_combinations<Exact>(*problem_, *stored_); });
        add([&] { return witness(); });
        add([&] {
            return check_forced<Fast>(*problem_, *stored_, hits_, options_.certificate.enclosure,
                                      0.5 * options_.seconds);
        });
        box_cover cover_found;
        add([&] {
            std::vector<box> rows;
            for (auto const& row : stored_->rows) rows.push_back(row.set);
            cover_found = cover(problem_->prior, rows);
            return check_cover(*problem_, *stored_, cover_found);
        });
        add([&] { return inside(); });
        add([&] { return outside(cover_found.gaps); });
        return all;
    }

private:
    using outcome = check_finding::outcome;

    /// The parameters and starts of the witness, if they fit the problem.
    struct point {
        std::vector<double> parameters;
        std::vector<std::vector<double>> starts;
    };
    [[nodiscard]] std::optional<point> witness_point(std::string& fault) const {
        point result;
        auto const look = [&](std::map<std::string, double> const& values,
                              std::string const& name) {
            auto const found = values.find(name);
            if (found == values.end()) fault = "the witness lacks " + name;
            return found == values.end() ? 0.0 : found->second;
        };
        for (auto const& name : problem_->choice.unknown) {
            result.parameters.push_back(look(stored_->witness->parameters, name));
        }
        if (!contains(problem_->prior, result.parameters)) fault = "the witness leaves the prior";
        for (auto const& e : problem_->experiments) {
            auto const found = stored_->witness->initial.find(e.name);
            if (found == stored_->witness->initial.end()) {
                fault = "the witness has no start for " + e.name;
                return std::nullopt;
            }
            auto& start = result.starts.emplace_back();
            for (auto const& state : problem_->model.about.states) {
                start.push_back(look(found->second, state.name));
            }
            if (!contains(e.initial, start)) fault = "the start in " + e.name + " is not allowed";
        }
        if (!fault.empty()) return std::nullopt;
        return result;
    }

    [[nodiscard]] check_finding witness() {
        std::string fault;
        if (!stored_->witness) return {"witness", outcome::nothing, fault};
        auto const w = witness_point(fault);
        if (!w) return {"witness", outcome::refuted, fault};
        enclosure_options const fine{
            .order = 14, .tolerance = 1e-11, .relative_tolerance = 1e-3, .minimum_step = 1e-6};
        check_finding result{"witness", outcome::verified, ""};
        std::size_t samples = 0;
        auto const p = point_box(w->parameters);
        for (std::size_t e = 0; e < problem_->experiments.size(); ++e) {
            auto own = problem_->experiments[e];
            bool const uncertain = any_uncertain(own.inputs);
            own.inputs = nominal(std::move(own.inputs)); // any possible input will do
            plain_run<Exact> run(problem_->model, problem_->choice, own, fine);
            auto const known = run(point_box(w->starts[e]), p);
            note_hits(e, known, run.samples());
            samples += run.samples().size();
            auto says = decide(known, run.samples(), p, own.outliers);
            if (says == run_finding::explained) continue;
            if (uncertain && says == run_finding::refuted) { // by the recorded inputs, not by all
                plain_run<Exact> all(problem_->model, problem_->choice, problem_->experiments[e],
                                     fine);
                says = decide(all(point_box(w->starts[e]), p), all.samples(), p, own.outliers);
            }
            if (says == run_finding::open && result.found == outcome::refuted) continue;
            result.found = says == run_finding::refuted ? outcome::refuted : outcome::undecided;
            result.detail = (says == run_finding::refuted ? "it does not explain "
                                                          : "no proof that it explains ") +
                            own.name;
        }
        if (result.found != outcome::verified) return result;
        result.detail = "explains " + std::to_string(samples) + " measurements by " +
                        std::to_string(problem_->experiments.size()) + " validated runs";
        for (auto const& s : w->starts) starts_.push_back(point_box(s));
        return result;
    }
    /// Which measurements the witness certainly meets: none of them can be a forced outlier.
    void note_hits(std::size_t e, plain_outputs<Exact> const& known, record const& samples) {
        using traits = interval_traits<Exact>;
        hits_.resize(problem_->experiments.size());
        for (std::size_t k = 0; k < samples.size(); ++k) {
            auto const& b = samples[k].bound;
            hits_[e].push_back(
                k < known.outputs.size() && known.outputs[k].defined &&
                traits::subset(known.outputs[k].value, traits::bounds(b.lower(), b.upper())));
        }
    }

    [[nodiscard]] check_finding inside() {
        std::vector<box_claim> claims;
        std::vector<std::size_t> rows;
        for (std::size_t k = 0; k < stored_->rows.size(); ++k) {
            if (stored_->rows[k].verdict == box_verdict::inside) rows.push_back(k);
        }
        auto const total = rows.size();
        std::mt19937_64 random(options_.seed);
        for (std::size_t k = 0; k < rows.size() && (options_.all || k < options_.sample); ++k) {
            if (!options_.all) std::swap(rows[k], rows[k + random() % (rows.size() - k)]);
            claims.push_back(
                {intersect(stored_->rows[rows[k]].set, problem_->prior), box_claim::kind::inside});
        }
        return prove("inside boxes", std::move(claims), total);
    }

    /// Half of the sample by volume, half box by box (most are thin and close to the feasible
    /// ones).
    [[nodiscard]] check_finding outside(std::vector<box> const& gaps) {
        std::vector<box_claim> claims;
        std::vector<double> until;
        double sum = 0;
        for (auto const& gap : gaps) {
            until.push_back(sum += relative_volume(gap, problem_->prior).upper());
            if (options_.all) claims.push_back({gap, box_claim::kind::outside});
        }
        std::mt19937_64 random(options_.seed + 1);
        auto const share = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
        for (std::size_t k = 0; k < options_.sample && !options_.all && !gaps.empty(); ++k) {
            auto n = static_cast<std::size_t>(random() % gaps.size());
            if (k % 2 == 0) {
                auto const at = std::lower_bound(until.begin(), until.end(), share() * sum);
                n = std::min(static_cast<std::size_t>(at - until.begin()), gaps.size() - 1);
            }
            auto part = gaps[n];
            for (std::size_t j = 0; j < part.size(); ++j) { // a part of a large one
                double const most = width(problem_->prior[j]) / 16, w = width(part[j]);
                if (!(w > most)) continue;
                double const low = part[j].lower() + share() * (w - most);
                part[j] = intersect(part[j], interval_traits<interval>::bounds(low, low + most));
            }
            claims.push_back({std::move(part), box_claim::kind::outside});
        }
        return prove("excluded boxes", std::move(claims), gaps.size());
    }

    [[nodiscard]] check_finding prove(std::string what, std::vector<box_claim> claims,
                                      std::size_t total) {
        if (claims.empty()) return {std::move(what), outcome::nothing, ""};
        auto how = options_.certificate;
        how.seconds = options_.seconds;
        if (options_.all) how.runs_per_claim = static_cast<std::size_t>(-1);
        claim_checker<Fast> checker(*problem_, starts_, how);
        checker(claims);
        auto const count = [&](box_claim::status s) {
            return static_cast<std::size_t>(std::count_if(
                claims.begin(), claims.end(), [s](box_claim const& c) { return c.found == s; }));
        };
        auto const proved = count(box_claim::status::proved);
        auto const refuted = count(box_claim::status::refuted);
        check_finding result{std::move(what), outcome::verified, ""};
        if (proved < claims.size()) result.found = outcome::undecided;
        if (refuted > 0) result.found = outcome::refuted;
        result.detail = std::to_string(proved) + " of " + std::to_string(claims.size()) + " proved";
        if (!options_.all) result.detail += ", a sample of " + std::to_string(total);
        if (refuted > 0) result.detail += ", " + std::to_string(refuted) + " refuted";
        result.detail += ", " + std::to_string(checker.runs()) + " runs";
        for (auto const& c : claims) {
            if (c.found != box_claim::status::refuted) continue;
            result.detail += "; the contrary holds at";
            for (std::size_t j = 0; j < c.counterexample.size(); ++j) {
                result.detail += " " + problem_->choice.unknown[j] + "=" +
                                 exact_decimal::shortest(c.counterexample[j]).text();
            }
            break;
        }
        return result;
    }
    identification_problem const* problem_;
    stored_identification const* stored_;
    identification_check_options options_;
    std::vector<box> starts_;             ///< of a verified witness
    std::vector<std::vector<bool>> hits_; ///< of the witness
};

/// The verdict on a whole result: refuted or undecided when anything is, else verified.
[[nodiscard]] inline check_finding::outcome overall(std::vector<check_finding> const& findings) {
    using outcome = check_finding::outcome;
    auto const any = [&](outcome o) {
        return std::any_of(findings.begin(), findings.end(),
                           [o](check_finding const& f) { return f.found == o; });
    };
    return any(outcome::refuted)     ? outcome::refuted
           : any(outcome::undecided) ? outcome::undecided
                                     : outcome::verified;
}

} // namespace sivid

#endif // SIVID_IO_IDENTIFICATION_CHECK_HPP

// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_PAVING_CHECK_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_PAVING_CHECK_HPP

#include <sivid/approximate/fit/detail/counterexample.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/paving/invert.hpp>
#include <sivid/paving/judge/feasibility_test.hpp>
#include <sivid/paving/products/detail/drawing.hpp>
#include <sivid/space/box_cover.hpp>
#include <sivid/verifier/check_finding.hpp>
#include <sivid/verifier/proof/detail/exclusion_check.hpp>
#include <sivid/verifier/proof/detail/plain_proof.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Checks that the boxes of a result follow from its paving of products, by the test that drew
/// them: what they leave of the prior has products in no row of products, and inside boxes have
/// products in inside rows alone. Nothing is integrated.
class drawing_check {
    using outcome = check_finding::outcome;

public:
    /// @param products  the rows, with what they leave of the products' prior as outside
    /// @param pieces    of boxes that are looked at before a claim is left open
    drawing_check(reduction const& map, subpaving const& products, box prior,
                  std::function<bool()> keep_going, std::size_t pieces = 400'000)
        : map_(&map),
          test_(map, products),
          prior_(std::move(prior)),
          keep_going_(std::move(keep_going)),
          left_(pieces) {}

    [[nodiscard]] check_finding inside(std::string what, std::vector<paved_box> const& rows) {
        std::size_t all = 0, proved = 0;
        for (auto const& row : rows) {
            if (row.verdict != box_verdict::inside) continue;
            ++all;
            proved += test_(row.set, nullptr).verdict == box_verdict::inside ? 1 : 0;
        }
        return finding(std::move(what), proved, all);
    }
    /// @param gaps  what the rows leave of the prior
    [[nodiscard]] check_finding excluded(std::string what, std::vector<paved_box> const& rows,
                                         std::vector<box> const& gaps) {
        faces_.assign(prior_.size(), {});
        for (auto const& row : rows)
            for (std::size_t j = 0; j < prior_.size(); ++j)
                for (double const end : {row.set[j].lower(), row.set[j].upper()})
                    faces_[j].push_back(end);
        for (auto& list : faces_) std::ranges::sort(list);
        std::size_t proved = 0;
        for (auto const& gap : gaps) proved += is_excluded(gap) ? 1 : 0;
        return finding(std::move(what), proved, gaps.size());
    }

private:
    [[nodiscard]] static check_finding finding(std::string what, std::size_t proved,
                                               std::size_t all) {
        if (all == 0) return {std::move(what), outcome::nothing, ""};
        return {std::move(what), proved == all ? outcome::verified : outcome::undecided,
                std::to_string(proved) + " of " + std::to_string(all) +
                    " follow from the products"};
    }
    /// Contacts with rows that the test narrows to a rounding count as none.
    [[nodiscard]] bool is_excluded(box const& gap) {
        struct piece {
            box set;
            std::shared_ptr<preimage_test::knowledge const> of_whole;
        };
        std::vector<piece> waiting{{gap, nullptr}};
        while (!waiting.empty()) {
            if (left_ == 0 || (keep_going_ && !keep_going_())) return false;
            --left_;
            auto const next = std::move(waiting.back());
            waiting.pop_back();
            auto const found = test_(next.set, next.of_whole);
            if (found.verdict == box_verdict::outside || is_contact(found.rest)) continue;
            auto const side = side_to_cut(found.rest);
            if (!side) return false;
            auto [low, high] = bisect(found.rest, *side, place_to_cut(*side, found.rest[*side]));
            waiting.push_back({std::move(low), found.knowledge});
            waiting.push_back({std::move(high), found.knowledge});
        }
        return true;
    }
    [[nodiscard]] bool is_contact(box const& x) const {
        for (std::size_t j = 0; j < x.size(); ++j)
            if (map_->acts(j) && !is_one_number(prior_[j]) && is_one_number(x[j])) return true;
        return false;
    }
    /// The widest against the prior's, as long as it is far more than a rounding.
    [[nodiscard]] std::optional<std::size_t> side_to_cut(box const& x) const {
        return io_detail::side_to_cut(
            x,
            [&](std::size_t j) {
                bool const cut = map_->acts(j) && !is_one_number(prior_[j]);
                return cut ? width(x[j]) / width(prior_[j]) : 0;
            },
            1e-13);
    }
    /// The face of a row next to the middle, the middle where there is none.
    [[nodiscard]] double place_to_cut(std::size_t j, interval const& x) const {
        auto const& faces = faces_[j];
        double const middle = mid(x);
        auto const inner = [&x](double at) { return x.lower() < at && at < x.upper(); };
        auto const next = std::ranges::lower_bound(faces, middle);
        double best = middle;
        double least = HUGE_VAL;
        auto const look = [&](double face) {
            if (!inner(face) || !(std::abs(face - middle) < least)) return;
            least = std::abs(face - middle);
            best = face;
        };
        if (next != faces.end()) look(*next);
        if (next != faces.begin()) look(*std::prev(next));
        return best;
    }

    reduction const* map_;
    preimage_test test_;
    box prior_;
    std::function<bool()> keep_going_;
    std::size_t left_;
    std::vector<std::vector<double>> faces_; ///< of the rows, by side
};

/// Checks a stored paving against its problem: its boxes cover the prior with what it excludes, and
/// what it says of boxes is proved anew, for a sample or for all: by the steps of its proof, by
/// first-order sets, then, for what these leave open, by the test of the search. Before that, fits
/// look for a point that contradicts it, in all boxes.
/// @tparam Fast  interval type of the runs over boxes
template <class Fast>
class paving_check {
    using outcome = check_finding::outcome;
    using status = box_claim::status;

public:
    /// @param names   of the sides, for counterexamples
    /// @param starts  of a verified witness; may be empty
    /// @param proof   of what the rows leave; may be empty, nothing in it is trusted
    paving_check(identification_problem const& problem, std::vector<std::string> names,
                 std::vector<paved_box> const& rows, std::vector<box> starts,
                 identification_check_options const& options, exclusion_proof proof = {})
        : problem_(&problem),
          names_(std::move(names)),
          rows_(&rows),
          starts_(std::move(starts)),
          options_(&options),
          proof_(std::move(proof)) {}

    /// The rows lie in the prior and share no volume; rows and gaps are all of it.
    [[nodiscard]] check_finding covering(std::string what) {
        auto found = cover(problem_->prior, sets(), 2e-15, options_->certificate.keep_going);
        covered_ = found.complete;
        gaps_ = std::move(found.gaps);
        if (!covered_) return {std::move(what), outcome::undecided, "not within the budget"};
        bool const within = std::ranges::all_of(
            *rows_, [this](auto const& row) { return subset(row.set, problem_->prior); });
        if (!within) return {std::move(what), outcome::refuted, "a box leaves the prior"};
        if (!found.overlaps.empty())
            return {std::move(what), outcome::refuted,
                    std::to_string(found.overlaps.size()) + " pairs of boxes overlap"};
        return {std::move(what), outcome::verified,
                "boxes disjoint; with " + std::to_string(gaps_.size()) +
                    " excluded boxes between them all of the prior"};
    }

    [[nodiscard]] check_finding inside(std::string what) {
        std::vector<box> boxes;
        for (auto const& row : *rows_)
            if (row.verdict == box_verdict::inside) boxes.push_back(row.set);
        auto const total = boxes.size();
        if (total == 0) return {std::move(what), outcome::nothing, ""};
        for (auto& x : boxes) {
            x = intersect(x, problem_->prior);
            if (is_empty(x))
                return {std::move(what), outcome::refuted, "one lies beside the prior"};
        }
        std::mt19937_64 random(options_->seed);
        std::ranges::shuffle(boxes, random); // should time not suffice for all
        std::optional<std::vector<double>> point;
        auto const fitted = std::min(boxes.size(), most_fitted());
        (void)find_unexplained_point(
            *problem_, {boxes.begin(), boxes.begin() + static_cast<std::ptrdiff_t>(fitted)},
            search([&](approximate_fit const& f) {
                if (!proves(f, false, run_finding::refuted)) return false;
                point = f.parameters;
                return true;
            }));
        if (point) return contradicted(std::move(what), *point);
        if (!options_->all) boxes.resize(std::min(boxes.size(), options_->sample));
        return prove(std::move(what), boxes, box_claim::kind::inside, total);
    }

    /// Half of the sample by volume, half box by box (most are thin and close to the feasible
    /// ones).
    /// @given  `covering` was called
    [[nodiscard]] check_finding outside(std::string what) {
        if (!covered_) return {std::move(what), outcome::undecided, "not within the budget"};
        if (gaps_.empty()) return {std::move(what), outcome::nothing, ""};
        if (auto const at = explaining_point()) return contradicted(std::move(what), *at);
        if (options_->all) return all_outside(std::move(what));
        std::vector<box> parts;
        std::vector<double> until;
        double sum = 0;
        for (auto const& gap : gaps_)
            until.push_back(sum += relative_volume(gap, problem_->prior).upper());
        std::mt19937_64 random(options_->seed + 1);
        auto const share = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
        for (std::size_t k = 0; k < options_->sample; ++k) {
            auto n = static_cast<std::size_t>(random() % gaps_.size());
            if (k % 2 == 0) {
                auto const at = std::lower_bound(until.begin(), until.end(), share() * sum);
                n = std::min(static_cast<std::size_t>(at - until.begin()), gaps_.size() - 1);
            }
            parts.push_back(part_of(gaps_[n], share));
        }
        return prove(std::move(what), parts, box_claim::kind::outside, gaps_.size());
    }

    /// What the rows leave of the prior.
    /// @given  `covering` was called
    [[nodiscard]] std::vector<box> const& gaps() const { return gaps_; }
    /// Whether the time sufficed for the gaps.
    [[nodiscard]] bool covered() const { return covered_; }

private:
    /// Of the time for a claim, the share in which fits look for what contradicts it.
    static constexpr double share_of_fits = 0.3;
    /// So many boxes are simulated, of excluded ones the largest, beside one fit in all of the
    /// prior. Where all is to be proved few will do.
    [[nodiscard]] std::size_t most_fitted() const { return options_->all ? 16 : 1024; }

    [[nodiscard]] std::vector<box> sets() const {
        std::vector<box> result;
        for (auto const& row : *rows_) result.push_back(row.set);
        return result;
    }
    /// A part of a box whose sides are large against the prior's, anywhere in it.
    template <class Share>
    [[nodiscard]] box part_of(box x, Share const& share) const {
        for (std::size_t j = 0; j < x.size(); ++j) {
            double const most = width(problem_->prior[j]) / 16, w = width(x[j]);
            if (!(w > most)) continue;
            double const low = x[j].lower() + share() * (w - most);
            x[j] = intersect(x[j], interval_traits<interval>::bounds(low, low + most));
        }
        return x;
    }
    [[nodiscard]] counterexample_options
    search(std::function<bool(approximate_fit const&)> confirms) const {
        counterexample_options how;
        how.seconds = share_of_fits * std::min(options_->seconds, 60.0);
        how.keep_going = options_->certificate.keep_going;
        how.confirms = std::move(confirms);
        return how;
    }
    [[nodiscard]] bool proves(approximate_fit const& f, bool at_its_starts,
                              run_finding what) const {
        return io_detail::judge_point<Fast>(*problem_, f, at_its_starts) == what;
    }
    /// A point that no row contains and that is proved to explain the data.
    [[nodiscard]] std::optional<std::vector<double>> explaining_point() const {
        std::optional<std::vector<double>> point;
        auto largest = gaps_;
        std::ranges::stable_sort(largest, std::ranges::greater{}, [this](box const& x) {
            return relative_volume(x, problem_->prior).upper();
        });
        largest.resize(std::min(largest.size(), most_fitted()));
        (void)find_explaining_point(*problem_, largest, search([&](approximate_fit const& f) {
            bool const said = contains(problem_->prior, f.parameters) &&
                              std::ranges::none_of(*rows_, [&](auto const& row) {
                                  return contains(row.set, f.parameters);
                              });
            if (!said || !proves(f, true, run_finding::explained)) return false;
            point = f.parameters;
            return true;
        }));
        return point;
    }
    [[nodiscard]] std::string words_of(std::vector<double> const& point) const {
        std::string text;
        for (std::size_t j = 0; j < point.size(); ++j)
            text += " " + names_[j] + "=" + exact_decimal::shortest(point[j]).text();
        return text;
    }
    [[nodiscard]] check_finding contradicted(std::string what,
                                             std::vector<double> const& at) const {
        return {std::move(what), outcome::refuted,
                "found by a fit, proved by a validated run: the contrary holds at" + words_of(at)};
    }

    /// By the steps of the proof, then, what they leave open, box by box.
    [[nodiscard]] check_finding all_outside(std::string what) {
        auto how = options_->certificate;
        how.seconds = options_->seconds;
        exclusion_check<Fast> exclude(*problem_, how, options_->run);
        auto const open = exclude.follow(proof_, sets());
        auto const steps = std::to_string(exclude.steps()) + " steps proved by their weights";
        check_finding found{what, outcome::verified, steps};
        if (exclude.over() && !open.empty()) // then rows are among what is open
            found = {what, outcome::undecided, steps + ", not within the budget"};
        else if (!open.empty()) {
            found = prove(what, open, box_claim::kind::outside, open.size());
            if (!proof_.empty()) found.detail = steps + "; of the rest " + found.detail;
        }
        if (exclude.contradictions() == 0) return found;
        if (found.found == outcome::verified) found.found = outcome::undecided;
        found.detail += "; two integrators contradict each other: a defect, please report it";
        return found;
    }

    /// By the test of the search, in parts: the claims that are open.
    /// @returns  how many it proves
    [[nodiscard]] std::size_t search_parts(std::vector<box_claim>& claims) const {
        std::size_t found = 0;
        feasibility_test_options how;
        static_cast<run_options&>(how) = options_->run;
        work_limit const limit(options_->seconds, options_->certificate.keep_going);
        feasibility_test test(*problem_, limited(how, limit));
        inversion_options parts;
        parts.boxes = options_->certificate.runs_per_claim;
        parts.accuracy = 1e-9; // the boxes end it
        parts.sufficient_ratio = 1;
        parts.keep_going = limit;
        for (auto& c : claims) {
            if (c.found != status::open || !limit()) continue;
            parts.seconds = limit.seconds();
            auto const paving = invert(test, c.set, parts).paving;
            bool const proved = std::ranges::all_of(paving.boxes(), [&](paved_box const& b) {
                return b.verdict == (c.what == box_claim::kind::inside ? box_verdict::inside
                                                                       : box_verdict::outside);
            });
            if (proved) c.found = status::proved;
            found += proved ? 1 : 0;
        }
        return found;
    }

    [[nodiscard]] check_finding prove(std::string what, std::vector<box> const& boxes,
                                      box_claim::kind kind, std::size_t total) const {
        if (boxes.empty())
            return {std::move(what), outcome::undecided,
                    "none of " + std::to_string(total) + " examined"};
        std::vector<box_claim> claims;
        for (auto const& x : boxes) claims.push_back({x, kind});
        auto const count = [&](status s) {
            return static_cast<std::size_t>(std::ranges::count(claims, s, &box_claim::found));
        };
        // What the steps of a proof leave open lies closer to what is left than first-order sets
        // can tell.
        bool const close = options_->all && kind == box_claim::kind::outside;
        std::size_t searched = close ? search_parts(claims) : 0;
        auto how = options_->certificate;
        how.seconds = 0.5 * options_->seconds;
        claim_checker<Fast> checker(*problem_, starts_, how);
        checker(claims);
        if (!close && count(status::open) > 0) searched = search_parts(claims);
        auto const proved = count(status::proved), refuted = count(status::refuted);
        auto const open = count(status::open);
        check_finding result{std::move(what),
                             refuted > 0     ? outcome::refuted
                             : open > 0      ? outcome::undecided
                             : options_->all ? outcome::verified
                                             : outcome::sampled,
                             std::to_string(proved) + " of " + std::to_string(claims.size()) +
                                 " proved"};
        auto& words = result.detail;
        if (!options_->all) words += ", a sample of " + std::to_string(total);
        if (searched > 0) words += ", " + std::to_string(searched) + " by the test of the search";
        if (refuted > 0) words += ", " + std::to_string(refuted) + " refuted";
        if (open > 0) words += ", " + std::to_string(open) + " not confirmed";
        words += ", " + std::to_string(checker.runs()) + " runs";
        auto const contrary = std::ranges::find(claims, status::refuted, &box_claim::found);
        if (contrary != claims.end())
            words += "; the contrary holds at" + words_of(contrary->counterexample);
        return result;
    }

    identification_problem const* problem_;
    std::vector<std::string> names_;
    std::vector<paved_box> const* rows_;
    std::vector<box> starts_;
    std::vector<box> gaps_; ///< what the rows leave of the prior
    bool covered_ = true;
    identification_check_options const* options_;
    exclusion_proof proof_;
};

} // namespace sivid

#endif

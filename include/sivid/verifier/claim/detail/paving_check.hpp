// SPDX-License-Identifier: MIT
#ifndef SIVID_VERIFIER_CLAIM_DETAIL_PAVING_CHECK_HPP
#define SIVID_VERIFIER_CLAIM_DETAIL_PAVING_CHECK_HPP

#include <sivid/approximate/fit/detail/counterexample.hpp>
#include <sivid/io/text/exact_decimal.hpp>
#include <sivid/number/text/nearest_text.hpp>
#include <sivid/space/box_cover.hpp>
#include <sivid/verifier/check_finding.hpp>
#include <sivid/verifier/claim/detail/stored_claims.hpp>
#include <sivid/verifier/proof/detail/exclusion_check.hpp>
#include <sivid/verifier/proof/detail/plain_proof.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Checks that the boxes of a result follow from its paving of products: what they leave of the
/// prior has products in no row of products, and inside boxes have products in inside rows alone.
/// Nothing is integrated: what is proved of the products is proved of the boxes.
///   Up to the last digits, in which the tables are rounded: contacts thinner than that count as
///   none.
/// @tparam I  in which products are evaluated
template <class I>
class drawing_check {
    using outcome = check_finding::outcome;

public:
    /// @param pieces  of boxes that are looked at before a claim is left open
    /// @param keep_going  once false, claims are left open; may be empty
    drawing_check(identification_problem const& problem, stored_identification const& stored,
                  stored_products const& rebuilt, std::size_t pieces = 400'000,
                  std::function<bool()> keep_going = nullptr)
        : problem_(&problem),
          stored_(&stored),
          rebuilt_(&rebuilt),
          most_(pieces),
          keep_going_(std::move(keep_going)) {
        auto const n = problem.prior.size();
        faces_.resize(n);
        for (auto const& row : stored.rows) {
            for (std::size_t j = 0; j < n; ++j) {
                faces_[j].push_back(row.set[j].lower());
                faces_[j].push_back(row.set[j].upper());
            }
        }
        for (auto& list : faces_) {
            std::sort(list.begin(), list.end());
            list.erase(std::unique(list.begin(), list.end()), list.end());
        }
    }

    /// @param gaps  what the rows leave of the prior, without slivers
    [[nodiscard]] check_finding excluded(std::string what, std::vector<box> const& gaps) {
        if (gaps.empty()) return {std::move(what), outcome::nothing, ""};
        std::size_t open = 0;
        for (auto const& gap : gaps) open += is_excluded(gap) ? 0 : 1;
        return finding(std::move(what), gaps.size(), open);
    }
    [[nodiscard]] check_finding inside(std::string what) {
        std::vector<box> rows;
        for (auto const& row : stored_->products->rows) {
            if (row.verdict == box_verdict::inside) rows.push_back(row.set);
        }
        std::size_t count = 0, open = 0;
        for (auto const& row : stored_->rows) {
            if (row.verdict != box_verdict::inside) continue;
            ++count;
            auto const image =
                io_detail::image_of<I>(*rebuilt_, intersect(row.set, problem_->prior));
            std::vector<box> left{image};
            if (std::ranges::all_of(image, [](interval const& side) { return is_bounded(side); })) {
                left = cover(image, rows, 2e-15, keep_going_).gaps;
                io_detail::drop_slivers(left, image);
            }
            open += left.empty() ? 0 : 1;
        }
        if (count == 0) return {std::move(what), outcome::nothing, ""};
        return finding(std::move(what), count, open);
    }

private:
    [[nodiscard]] static check_finding finding(std::string what, std::size_t count,
                                               std::size_t open) {
        auto detail = std::to_string(count - open) + " of " + std::to_string(count) +
                      " follow from the products";
        return {std::move(what), open == 0 ? outcome::verified : outcome::undecided,
                std::move(detail)};
    }
    /// Whether a row has more than a rounding error in common with an image.
    [[nodiscard]] bool meets(box const& row, box const& image) const {
        for (std::size_t k = 0; k < row.size(); ++k) {
            double const common = std::min(row[k].upper(), image[k].upper()) -
                                  std::max(row[k].lower(), image[k].lower());
            auto const& whole = rebuilt_->problem.prior[k];
            if (io_detail::is_sliver(common, mag(row[k]), whole) && row[k].lower() < row[k].upper())
                return false;
            if (common < 0) return false;
        }
        return true;
    }

    [[nodiscard]] bool late() const { return keep_going_ && !keep_going_(); }

    [[nodiscard]] bool is_excluded(box const& gap) {
        if (late()) return false;
        struct piece {
            box set;
            std::vector<std::size_t> near;
        };
        std::vector<std::size_t> all(stored_->products->rows.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        std::vector<piece> waiting{{gap, std::move(all)}};
        while (!waiting.empty()) {
            auto const next = std::move(waiting.back());
            waiting.pop_back();
            auto const image = io_detail::image_of<I>(*rebuilt_, next.set);
            auto near = next.near;
            std::erase_if(
                near, [&](std::size_t k) { return !meets(stored_->products->rows[k].set, image); });
            if (near.empty()) continue;
            auto const cut = place_to_cut(next.set);
            if (!cut || spent_++ >= most_ || late()) return false;
            auto [low, high] = bisect(next.set, cut->first, cut->second);
            waiting.push_back({std::move(low), near});
            waiting.push_back({std::move(high), std::move(near)});
        }
        return true;
    }

    /// The face of a row next to the middle of a side, the middle where there is none; the side
    /// that is widest against the prior's, those with faces first.
    [[nodiscard]] std::optional<std::pair<std::size_t, double>> place_to_cut(box const& x) const {
        std::optional<std::pair<std::size_t, double>> best;
        double most = 0;
        for (std::size_t j = 0; j < x.size(); ++j) {
            double const whole = width(problem_->prior[j]);
            double const w = x[j].upper() - x[j].lower(), middle = mid(x[j]);
            if (!acts(j) || !(whole > 0) || !(w > 1e-13 * whole) || !(w > 0x1p-48 * mag(x[j]))) {
                continue;
            }
            auto const next = std::lower_bound(faces_[j].begin(), faces_[j].end(), middle);
            std::optional<double> face;
            auto const look = [&](double f) {
                double const room = 0x1p-50 * mag(x[j]);
                if (!(f > x[j].lower() + room) || !(f < x[j].upper() - room)) return;
                if (!face || std::abs(f - middle) < std::abs(*face - middle)) face = f;
            };
            if (next != faces_[j].end()) look(*next);
            if (next != faces_[j].begin()) look(*std::prev(next));
            double const rank = w / whole + (face ? 2 : 0);
            if (rank <= most) continue;
            most = rank;
            best = {j, face.value_or(middle)};
        }
        return best;
    }
    [[nodiscard]] bool acts(std::size_t j) const {
        return std::any_of(rebuilt_->sides.begin(), rebuilt_->sides.end(),
                           [j](auto const& side) { return side.exponents()[j] != 0; });
    }

    identification_problem const* problem_;
    stored_identification const* stored_;
    stored_products const* rebuilt_;
    std::vector<std::vector<double>> faces_; ///< of the rows, by side
    std::size_t most_, spent_ = 0;
    std::function<bool()> keep_going_;
};

/// Checks a stored paving against its problem: its boxes cover the prior with what it excludes, and
/// what it says of boxes is proved anew, for a sample or for all. Before that, fits look for a
/// point that contradicts it, in all boxes.
/// @tparam Fast  interval type of the runs over boxes
template <class Fast>
class paving_check {
    using outcome = check_finding::outcome;

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

    /// Inside rows are printed inward: a few floats between neighbours are in none, and nothing is
    /// said of them.
    [[nodiscard]] check_finding covering(std::string what) {
        std::vector<box> sets;
        for (auto const& row : *rows_) sets.push_back(row.set);
        auto found = cover(problem_->prior, sets, 2e-15, options_->certificate.keep_going);
        auto result = check_cover(std::move(what), *problem_, *rows_, found);
        covered_ = found.complete;
        gaps_ = std::move(found.gaps);
        io_detail::drop_slivers(gaps_, problem_->prior);
        return result;
    }

    [[nodiscard]] check_finding inside(std::string what) {
        std::vector<box_claim> claims;
        std::vector<std::size_t> rows;
        for (std::size_t k = 0; k < rows_->size(); ++k) {
            if ((*rows_)[k].verdict == box_verdict::inside) rows.push_back(k);
        }
        auto const total = rows.size();
        if (total == 0) return {std::move(what), outcome::nothing, ""};
        if (std::any_of(rows.begin(), rows.end(), [&](std::size_t k) {
                return is_empty(intersect((*rows_)[k].set, problem_->prior));
            })) {
            return {std::move(what), outcome::refuted, "one lies beside the prior"};
        }
        std::mt19937_64 random(options_->seed);
        if (auto const at = unexplained_point(rows, random)) return contradicted(what, *at);
        for (std::size_t k = 0; k < rows.size() && (options_->all || k < options_->sample); ++k) {
            if (!options_->all) std::swap(rows[k], rows[k + random() % (rows.size() - k)]);
            claims.push_back(
                {intersect((*rows_)[rows[k]].set, problem_->prior), box_claim::kind::inside});
        }
        return prove(std::move(what), std::move(claims), total);
    }

    /// Half of the sample by volume, half box by box (most are thin and close to the feasible
    /// ones).
    /// @given  `covering` was called
    [[nodiscard]] check_finding outside(std::string what) {
        if (!covered_) return io_detail::late(std::move(what));
        if (gaps_.empty()) return {std::move(what), outcome::nothing, ""};
        if (auto const at = explaining_point()) return contradicted(what, *at);
        if (options_->all) return all_outside(std::move(what));
        std::vector<box_claim> claims;
        std::vector<double> until;
        double sum = 0;
        for (auto const& gap : gaps_) {
            until.push_back(sum += relative_volume(gap, problem_->prior).upper());
        }
        std::mt19937_64 random(options_->seed + 1);
        auto const share = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
        for (std::size_t k = 0; k < options_->sample; ++k) {
            auto n = static_cast<std::size_t>(random() % gaps_.size());
            if (k % 2 == 0) {
                auto const at = std::lower_bound(until.begin(), until.end(), share() * sum);
                n = std::min(static_cast<std::size_t>(at - until.begin()), gaps_.size() - 1);
            }
            auto part = gaps_[n];
            io_detail::shrink_to_share(part, problem_->prior, share);
            claims.push_back({std::move(part), box_claim::kind::outside});
        }
        return prove(std::move(what), std::move(claims), gaps_.size());
    }

    /// What the rows leave of the prior, but for rounding.
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
        auto const volume = [this](box const& x) {
            return relative_volume(x, problem_->prior).upper();
        };
        std::ranges::stable_sort(largest, std::ranges::greater{}, volume);
        largest.resize(std::min(largest.size(), most_fitted()));
        (void)find_explaining_point(*problem_, largest, search([&](approximate_fit const& f) {
            bool const said = contains(problem_->prior, f.parameters) &&
                              std::none_of(rows_->begin(), rows_->end(), [&](auto const& row) {
                                  return contains(row.set, f.parameters);
                              });
            if (!said || !proves(f, true, run_finding::explained)) return false;
            point = f.parameters;
            return true;
        }));
        return point;
    }
    /// A point of an inside row that is proved not to.
    [[nodiscard]] std::optional<std::vector<double>>
    unexplained_point(std::vector<std::size_t> const& rows, std::mt19937_64 random) const {
        std::vector<box> inside;
        for (auto const k : rows) {
            auto x = intersect((*rows_)[k].set, problem_->prior);
            if (!is_empty(x)) inside.push_back(std::move(x));
        }
        std::shuffle(inside.begin(), inside.end(), random); // should time not suffice for all
        inside.resize(std::min(inside.size(), most_fitted()));
        std::optional<std::vector<double>> point;
        (void)find_unexplained_point(*problem_, inside, search([&](approximate_fit const& f) {
            if (!proves(f, false, run_finding::refuted)) return false;
            point = f.parameters;
            return true;
        }));
        return point;
    }
    [[nodiscard]] std::string words_of(std::vector<double> const& point) const {
        std::string text;
        for (std::size_t j = 0; j < point.size(); ++j) {
            text += " " + names_[j] + "=" + exact_decimal::shortest(point[j]).text();
        }
        return text;
    }
    [[nodiscard]] check_finding contradicted(std::string what,
                                             std::vector<double> const& at) const {
        return {std::move(what), outcome::refuted,
                "found by a fit, proved by a validated run: the contrary holds at" + words_of(at)};
    }

    /// What is left of an excluded box without its rim; nothing of one that is thinner than that.
    [[nodiscard]] std::optional<box> without_rim(box x) const {
        for (std::size_t j = 0; j < x.size(); ++j) {
            auto const& side = problem_->prior[j];
            double const off = options_->rim * width(side);
            double const low = x[j].lower() > side.lower() ? x[j].lower() + off : x[j].lower();
            double const high = x[j].upper() < side.upper() ? x[j].upper() - off : x[j].upper();
            if (!(low <= high)) return std::nullopt;
            x[j] = interval_traits<interval>::bounds(low, high);
        }
        return x;
    }

    /// Contraction cuts so close to the feasible set that no run with a tolerance of its own can
    /// follow: what is open is tried without its rim.
    struct rim_findings {
        std::size_t proved = 0; ///< but for their rims; their claims are `proved` now
        std::size_t thin = 0;   ///< all rim: nothing is said of them, their claims stay open
    };
    [[nodiscard]] rim_findings prove_without_rim(std::vector<box_claim>& claims,
                                                 claim_checker<Fast>& checker) const {
        rim_findings found;
        std::vector<box_claim> inner;
        std::vector<box_claim*> whose;
        for (auto& c : claims) {
            if (c.found != box_claim::status::open || c.what != box_claim::kind::outside) continue;
            if (auto left = without_rim(c.set)) {
                inner.push_back({std::move(*left), box_claim::kind::outside});
                whose.push_back(&c);
            } else {
                ++found.thin;
            }
        }
        if (inner.empty()) return found;
        checker(inner);
        for (std::size_t k = 0; k < inner.size(); ++k) {
            whose[k]->found = inner[k].found;
            whose[k]->counterexample = inner[k].counterexample;
            found.proved += inner[k].found == box_claim::status::proved ? 1 : 0;
        }
        return found;
    }

    [[nodiscard]] certificate_options effort() const {
        auto how = options_->certificate;
        how.seconds = options_->seconds;
        if (options_->all) how.runs_per_claim = static_cast<std::size_t>(-1);
        return how;
    }

    /// By the steps of the proof, then, what they leave open, box by box.
    [[nodiscard]] check_finding all_outside(std::string what) {
        std::vector<box> rows;
        for (auto const& row : *rows_) rows.push_back(row.set);
        exclusion_check<Fast> exclude(*problem_, effort(), options_->run);
        auto open = exclude.follow(proof_, rows);
        bool const late = exclude.over(); // then rows are among what is open
        io_detail::drop_slivers(open, problem_->prior);
        std::string const steps = std::to_string(exclude.steps()) + " steps proved, " +
                                  std::to_string(exclude.by_weights()) +
                                  " by the weights of the result";
        auto const sound = [&](check_finding found) {
            if (exclude.contradictions() == 0) return found;
            if (found.found == outcome::verified) found.found = outcome::undecided;
            found.detail += "; two integrators contradict each other: a defect, please report it";
            return found;
        };
        if (late && !open.empty())
            return sound({std::move(what), outcome::undecided, steps + ", not within the budget"});
        if (open.empty()) {
            return sound({std::move(what), outcome::verified,
                          steps + ", " + std::to_string(exclude.runs()) + " runs"});
        }
        std::vector<box_claim> claims;
        for (auto& gap : open) claims.push_back({std::move(gap), box_claim::kind::outside});
        exclude(claims);
        auto const total = claims.size();
        auto result = prove(std::move(what), std::move(claims), total, exclude.runs());
        if (!proof_.empty()) result.detail = steps + "; of the rest " + result.detail;
        return sound(std::move(result));
    }

    /// @param runs  that were spent on the claims before
    [[nodiscard]] check_finding prove(std::string what, std::vector<box_claim> claims,
                                      std::size_t total, std::size_t runs = 0) {
        if (claims.empty()) {
            return {std::move(what), outcome::undecided,
                    "none of " + std::to_string(total) + " examined"};
        }
        auto const how = effort();
        claim_checker<Fast> checker(*problem_, starts_, how);
        checker(claims);
        auto const rim = prove_without_rim(claims, checker);
        auto const count = [&](box_claim::status s) {
            return static_cast<std::size_t>(std::count_if(
                claims.begin(), claims.end(), [s](box_claim const& c) { return c.found == s; }));
        };
        auto const proved = count(box_claim::status::proved);
        auto const refuted = count(box_claim::status::refuted);
        bool const whole = options_->all && rim.proved == 0 && rim.thin == 0;
        check_finding result{std::move(what), whole ? outcome::verified : outcome::sampled, ""};
        if (proved + rim.thin < claims.size()) result.found = outcome::undecided;
        if (refuted > 0) result.found = outcome::refuted;
        result.detail = std::to_string(proved - rim.proved) + " of " +
                        std::to_string(claims.size()) + " proved";
        if (!options_->all) result.detail += ", a sample of " + std::to_string(total);
        if (refuted > 0) result.detail += ", " + std::to_string(refuted) + " refuted";
        if (auto const open = claims.size() - proved - refuted - rim.thin; open > 0) {
            result.detail += ", " + std::to_string(open) + " not confirmed";
        }
        auto const size = nearest_text(options_->rim, 3) + " of the prior";
        if (rim.proved > 0) {
            result.detail += ", " + std::to_string(rim.proved) + " more but for a rim of " + size;
        }
        if (rim.thin > 0) {
            result.detail +=
                ", " + std::to_string(rim.thin) + " thinner than " + size + " not examined";
        }
        result.detail += ", " + std::to_string(runs + checker.runs()) + " runs";
        for (auto const& c : claims) {
            if (c.found != box_claim::status::refuted) continue;
            result.detail += "; the contrary holds at" + words_of(c.counterexample);
            break;
        }
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

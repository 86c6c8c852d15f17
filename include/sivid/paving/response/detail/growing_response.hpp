// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_RESPONSE_DETAIL_GROWING_RESPONSE_HPP
#define SIVID_PAVING_RESPONSE_DETAIL_GROWING_RESPONSE_HPP

#include <sivid/paving/response/detail/affine_output.hpp>
#include <sivid/paving/response/local_response.hpp>
#include <sivid/paving/response/response.hpp>
#include <sivid/space/box.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

/// What is known of a measurement for all parameters of a live box.
enum class sample_status {
    unreached, ///< the enclosure did not get so far
    open,
    holds, ///< certainly, whatever the start
    fails  ///< certainly, whatever the start
};

/// The response of an experiment over a box of parameters, to which measurements are added as they
/// arrive. What certainly holds or fails over all that is still live of the box is counted and
/// leaves the polynomials, so that these stay few however many measurements come.
/// @guarantee  on every part of the live box the response says the same of feasibility as that of
///             all measurements: n and q are reduced by what is certain
class growing_response {
public:
    growing_response(normalised_unknowns unknowns, std::shared_ptr<monomial_table const> table,
                     std::size_t outliers)
        : known_(std::make_shared<response>(
              response{std::move(unknowns), std::move(table), {}, {}, {}, {}, 0, outliers})) {}

    /// A measurement with what the family's output is at its time.
    struct arrival {
        std::size_t sample = 0; ///< its number; numbers are used once
        interval bound;
        output_polynomial output;
    };

    /// For as many measurements as arrive together.
    void take(std::vector<arrival> const& arrivals, box const& live) {
        forget_news();
        if (arrivals.empty()) return;
        response_builder all(known_->table->size());
        std::vector<std::size_t> samples;
        for (auto const& a : arrivals) {
            all.add([&](std::size_t m) { return a.output.coefficients[m]; }, a.output.radius,
                    a.bound);
            samples.push_back(a.sample);
        }
        response news{known_->unknowns, known_->table, {}, {}, {}, {}, arrivals.size(), 0};
        std::move(all).finish(news);
        append(news, samples, classify(news, samples, live));
    }
    /// For measurements whose time the enclosure does not reach.
    void miss(std::size_t sample) {
        if (sample >= status_.size()) status_.resize(sample + 1, sample_status::unreached);
        ++known_->measurements;
        lost_ = true;
    }
    void forget_news() {
        news_.clear();
        lost_ = failed_now_ = false;
    }

    /// Counts what is certain over a live box that has become smaller.
    void settle(box const& live) {
        auto const status = classify(*known_, samples_, live);
        if (std::all_of(status.begin(), status.end(),
                        [](sample_status s) { return s == sample_status::open; })) {
            return;
        }
        auto const old = *known_;
        auto const samples = samples_;
        known_->coefficients.clear();
        known_->radius.clear();
        known_->bounds.clear();
        known_->measurements -= status.size(); // `append` adds them again
        samples_.clear();
        append(old, samples, status);
        forget_news(); // none of it is new to the parts of the live box
    }

    /// More measurements than allowed certainly fail.
    [[nodiscard]] bool refuted() const { return refuted_; }
    /// Whether what came last can change what is known of a part of the live box: false when all of
    /// it certainly holds there.
    [[nodiscard]] bool concerned(box const& part) const {
        if (lost_ || failed_now_) return true;
        if (news_.empty()) return false;
        response fresh{known_->unknowns, known_->table, {}, {}, {}, {}, news_.size(), 0};
        response_builder rows(known_->table->size());
        for (auto const y : news_) {
            rows.add([&](std::size_t m) { return known_->coefficients[m * known_->outputs() + y]; },
                     known_->radius[y], known_->bounds[y]);
        }
        std::move(rows).finish(fresh);
        auto const values = output_ranges(fresh, part);
        for (std::size_t y = 0; y < values.size(); ++y) {
            if (!subset(values[y], fresh.bounds[y])) return true;
        }
        return false;
    }

    [[nodiscard]] std::shared_ptr<response const> known() const { return known_; }
    /// What is known of a measurement over a part of the live box.
    [[nodiscard]] sample_status status(std::size_t sample, box const& part) const {
        if (sample >= status_.size()) return sample_status::unreached;
        auto const at = std::find(samples_.begin(), samples_.end(), sample);
        if (at == samples_.end()) return status_[sample];
        return classify(*known_, samples_, part)[static_cast<std::size_t>(at - samples_.begin())];
    }

private:
    [[nodiscard]] static std::vector<sample_status>
    classify(response const& r, std::vector<std::size_t> const& samples, box const& live) {
        std::vector<sample_status> status(samples.size(), sample_status::open);
        if (samples.empty()) return status;
        auto const values = output_ranges(r, live);
        for (std::size_t y = 0; y < values.size(); ++y) {
            if (disjoint(values[y], r.bounds[y])) status[y] = sample_status::fails;
            if (subset(values[y], r.bounds[y])) status[y] = sample_status::holds;
        }
        return status;
    }

    /// Takes over the open rows of another response with the same monomials, and counts the rest.
    void append(response const& from, std::vector<std::size_t> const& samples,
                std::vector<sample_status> const& status) {
        auto const old = known_->outputs();
        auto const count =
            static_cast<std::size_t>(std::count(status.begin(), status.end(), sample_status::open));
        std::vector<double> c((old + count) * known_->table->size());
        for (std::size_t m = 0; m < known_->table->size(); ++m) {
            auto to = c.begin() + static_cast<std::ptrdiff_t>(m * (old + count));
            auto const mine = known_->coefficients.begin() + static_cast<std::ptrdiff_t>(m * old);
            to = std::copy(mine, mine + static_cast<std::ptrdiff_t>(old), to);
            for (std::size_t y = 0; y < status.size(); ++y) {
                if (status[y] == sample_status::open) {
                    *to++ = from.coefficients[m * from.outputs() + y];
                }
            }
        }
        known_->coefficients = std::move(c);
        for (std::size_t y = 0; y < status.size(); ++y) {
            if (samples[y] >= status_.size()) {
                status_.resize(samples[y] + 1, sample_status::unreached);
            }
            status_[samples[y]] = status[y];
            if (status[y] == sample_status::holds) continue;
            if (status[y] == sample_status::fails) {
                failed_now_ = true;
                if (known_->allowed > 0) {
                    --known_->allowed;
                } else { // counts as unknown from now on, so that the rest explains nothing
                    refuted_ = true;
                    ++known_->measurements;
                }
                continue;
            }
            news_.push_back(samples_.size());
            samples_.push_back(samples[y]);
            known_->radius.push_back(from.radius[y]);
            known_->bounds.push_back(from.bounds[y]);
            ++known_->measurements;
        }
    }

    std::shared_ptr<response> known_;
    std::vector<std::size_t> samples_;  ///< numbers of the open rows
    std::vector<sample_status> status_; ///< by number
    std::vector<std::size_t> news_;     ///< open rows of the last arrival
    bool refuted_ = false, lost_ = false, failed_now_ = false;
};

} // namespace sivid

#endif

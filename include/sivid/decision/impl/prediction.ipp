// SPDX-License-Identifier: MIT
#ifndef SIVID_DECISION_IMPL_PREDICTION_IPP
#define SIVID_DECISION_IMPL_PREDICTION_IPP

#include <sivid/decision/prediction.hpp>

#include <sivid/compiled.hpp>
#include <sivid/decision/motion/detail/motion_cover.hpp>
#include <sivid/decision/motion/detail/open_parts.hpp>
#include <sivid/enclosure/suggested_degree.hpp>
#include <sivid/paving/contract/detail/lifted_program.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace sivid {

namespace decision_detail {

class prediction_search {
public:
    prediction_search(prediction_problem const& problem, prediction_options const& options,
                      std::vector<node_id> const& further)
        : problem_(problem),
          options_(options),
          limit_(options.seconds, options.keep_going),
          outputs_(problem.model, further) {
        options_.run.keep_going = limit_;
        if (many() && options_.run.degree == 0)
            options_.run.degree = sharp_degree(problem.around().size());
        cover_.emplace(
            problem, outputs_,
            time_cells(problem, {},
                       problem.end / static_cast<double>(std::max<std::size_t>(options.cells, 1))),
            options_.run);
    }

    [[nodiscard]] prediction operator()() {
        stopwatch const clock;
        parts_.push_back({cover_->whole(), {}});
        learn({&parts_.front()});
        if (many()) ask_data();
        finish_parts();
        auto left = excess();
        while (left.largest > options_.excess && going()) {
            if (!refine(left)) break;
            left = excess();
        }
        prediction result;
        result.times = cover_->times();
        // Of what no parameter may reach nothing is known that is.
        if (!problem_.reached) result.excess = left.largest;
        sharpen();
        collect(result);
        result.parts = parts_.size();
        result.integrations = integrations_ + cover_->integrations();
        result.seconds = clock.spent();
        return result;
    }

private:
    struct item {
        motion_cover::part what;
        motion_cover::view seen;
        bool settled = false; ///< no half gets further
    };
    using items = std::list<item>;
    /// How much wider the tube is than what is reached, and which parts hold its bounds.
    struct excess_found {
        double largest = 0;
        std::vector<std::pair<double, item*>> holders; ///< heaviest first
    };

    [[nodiscard]] static std::size_t open_sides(box const& x) {
        return static_cast<std::size_t>(std::count_if(
            x.begin(), x.end(), [](interval const& side) { return width(side) > 0; }));
    }
    /// Many parameters are known in combinations that lie across the sides.
    [[nodiscard]] bool many() const {
        auto const open = open_sides(problem_.around());
        return problem_.measured && open >= 4 && open <= most_oblique;
    }
    /// Whether programs over the data, with products of combinations, can draw the ends in: far
    /// more than halving does.
    void ask_data() {
        auto const data = problem_.measured(parts_.front().what.parameters, limit_);
        auto unknowns = open_sides(problem_.around()) + open_sides(problem_.initial);
        for (auto const& start : data.starts) unknowns += open_sides(start);
        oblique_ = !data.known.empty() && unknowns <= most_oblique;
        if (oblique_) options_.excess = std::max(options_.excess, coarse_excess);
    }
    [[nodiscard]] bool going() const { return limit_() && parts_.size() < options_.parts; }

    void learn(std::vector<item*> const& which) {
        std::vector<motion_cover::part*> parts;
        for (auto* i : which) parts.push_back(&i->what);
        cover_->learn(parts);
        for (auto* i : which) i->seen = cover_->look(i->what);
    }

    /// Halves of an item in its place; empty when it cannot be cut.
    std::vector<item*> replace(item* which, std::vector<motion_cover::part> halves) {
        if (halves.empty()) return {};
        auto const at = std::find_if(parts_.begin(), parts_.end(),
                                     [which](item const& i) { return &i == which; });
        std::vector<item*> result;
        for (auto& h : halves) result.push_back(&*parts_.insert(at, {std::move(h), {}}));
        parts_.erase(at);
        return result;
    }

    /// Parts that were not carried to the end, or lost too much, are halved and integrated anew.
    void finish_parts() {
        while (going()) {
            refine_grid();
            std::vector<item*> short_of;
            for (auto& i : parts_) {
                if (!i.settled && !i.what.known->complete) short_of.push_back(&i);
                if (2 * short_of.size() >= cover_->at_once()) break;
            }
            if (short_of.empty()) return;
            std::vector<item*> next;
            for (auto* i : short_of) {
                // A hundred-thousandth of the whole that gets no further will not by halving.
                bool const tiny = cover_->widest_share(i->what) < 1e-5;
                auto const moved = cover_->lost_by_sides(i->what, i->seen);
                auto const halves = replace(i, tiny ? std::vector<motion_cover::part>{}
                                                    : cover_->split_by(moved, i->what));
                if (halves.empty()) i->settled = true;
                next.insert(next.end(), halves.begin(), halves.end());
            }
            if (!next.empty()) learn(next);
        }
    }

    /// Cells that are too long for bounds in between, although both ends are known, are cut in
    /// four: no smaller box helps where a motion is quick.
    void refine_grid() {
        for (; refinements_ < 6 && limit_(); ++refinements_) {
            std::set<std::size_t> cells;
            for (auto const& i : parts_) {
                auto const& known = *i.what.known;
                if (known.reached < cover_->times().size()) continue;
                for (std::size_t c = 0; c < known.courses.size(); ++c)
                    if (known.courses[c].empty()) cells.insert(c);
            }
            if (cells.empty()) return;
            integrations_ += cover_->integrations();
            auto times = finer_grid(cover_->times(), cells);
            cover_.emplace(problem_, outputs_, std::move(times), options_.run);
            std::vector<item*> all;
            for (auto& i : parts_) {
                i.what.known = nullptr;
                all.push_back(&i);
            }
            learn(all);
        }
    }

    [[nodiscard]] excess_found excess() {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        auto const m = cover_->outputs();
        std::size_t reached = cover_->times().size();
        for (auto const& i : parts_) reached = std::min(reached, i.seen.reached);
        auto const count = reached * m;
        std::vector<double> low(count, infinity), high(count, -infinity), inner_low(low),
            inner_high(high);
        std::vector<item*> lowest(count), highest(count);
        for (auto& i : parts_) {
            for (std::size_t y = 0; y < count; ++y) {
                double const rest = 2 * i.seen.rest[y];
                if (i.seen.low[y] < low[y]) {
                    low[y] = i.seen.low[y];
                    lowest[y] = &i;
                }
                if (i.seen.high[y] > high[y]) {
                    high[y] = i.seen.high[y];
                    highest[y] = &i;
                }
                inner_low[y] = std::min(inner_low[y], i.seen.low[y] + rest);
                inner_high[y] = std::max(inner_high[y], i.seen.high[y] - rest);
            }
        }
        excess_found result;
        std::map<item*, double> weight;
        std::vector<double> size(m, 0.0); // of each output, the largest at any instant
        for (std::size_t y = 0; y < count; ++y) {
            double const most = std::max(std::abs(low[y]), std::abs(high[y]));
            if (std::isfinite(most)) size[y % m] = std::max(size[y % m], most);
        }
        for (std::size_t y = 0; y < count; ++y) {
            double const width = high[y] - low[y];
            double const tiny = 1e-6 * size[y % m];
            double const attained = std::max(inner_high[y] - inner_low[y], 0.0) + tiny;
            double const share = !std::isfinite(width) ? infinity
                                 : width > tiny        ? (width - tiny) / attained - 1
                                                       : -1;
            result.largest = std::max(result.largest, share);
            if (!(share > options_.excess)) continue;
            double const heavy = std::min(share, 10.0);
            weight[lowest[y]] += heavy;
            weight[highest[y]] += heavy;
        }
        if (reached < cover_->times().size()) result.largest = infinity;
        for (auto const& [i, w] : weight) {
            if (i != nullptr && !i->settled) result.holders.emplace_back(w, i);
        }
        std::sort(result.holders.begin(), result.holders.end(),
                  [](auto const& a, auto const& b) { return a.first > b.first; });
        return result;
    }

    /// Halves the parts that hold the bounds. @returns false when nothing can be done
    bool refine(excess_found const& found) {
        std::vector<item*> fresh;
        bool any = false;
        std::size_t taken = 0;
        for (auto const& [heavy, i] : found.holders) {
            if (taken == cover_->at_once() || heavy < 0.05 * found.holders.front().first) break;
            ++taken;
            bool const worn = lost_share(*i) > 0.4;
            auto halves = cover_->split_by(cover_->curved_by_sides(i->what, i->seen), i->what);
            if (halves.empty()) {
                i->settled = true;
                continue;
            }
            auto const next = replace(i, std::move(halves));
            any = true;
            for (auto* n : next) {
                if (worn)
                    fresh.push_back(n);
                else
                    n->seen = cover_->look(n->what);
            }
        }
        if (!fresh.empty()) learn(fresh);
        finish_parts();
        return any;
    }

    /// How much of the rests was lost on the way, on the whole.
    [[nodiscard]] static double lost_share(item const& i) {
        double lost = 0, all = 0;
        auto const& radius = i.what.known->answer->radius;
        for (std::size_t y = 0; y < i.seen.rest.size(); ++y) {
            double const reach = i.seen.high[y] - i.seen.low[y];
            if (!(reach > 0) || !std::isfinite(reach)) continue;
            lost += radius[y] / reach;
            all += i.seen.rest[y] / reach;
        }
        return all > 0 ? lost / all : 1;
    }
    /// What a part's motion and the measurements say together.
    struct measured_part {
        response_list known; ///< the measured ones, then the motion
        std::unique_ptr<lifted_program> program;

        measured_part(measured_responses data, motion_cover::part const& p, bool oblique)
            : known(std::move(data.known)) {
            known.push_back(p.known->answer);
            data.starts.push_back(p.initial);
            program = std::make_unique<lifted_program>(known, p.parameters, data.starts,
                                                       curved_share, oblique);
        }
        [[nodiscard]] double end_of(std::size_t output, bool upwards) const {
            return program->end_of(known.size() - 1, output, upwards);
        }
    };

    /// Draws in the ends of the tube, at the instants, to what the measurements leave of the parts
    /// that hold them.
    void sharpen() {
        if (!problem_.measured) return;
        std::map<void const*, measured_responses> data;
        std::map<item const*, measured_part> measured;
        auto const of = [&](item const& i) -> measured_part const* {
            // Of each of a few parts by itself, else of the box around many.
            bool const few = parts_.size() <= 8;
            auto const [at, fresh] =
                data.try_emplace(few ? static_cast<void const*>(&i) : i.what.known.get());
            if (fresh)
                at->second =
                    problem_.measured(few ? i.what.parameters : i.what.known->parameters, limit_);
            if (at->second.known.empty()) return nullptr;
            return &measured.try_emplace(&i, at->second, i.what, oblique_).first->second;
        };
        std::size_t reached = cover_->times().size();
        for (auto const& i : parts_) reached = std::min(reached, i.seen.reached);
        for (std::size_t y = 0; y < reached * cover_->outputs(); ++y) {
            for (bool const upwards : {false, true}) {
                auto const end = [&](item& i) -> double& {
                    return upwards ? i.seen.high[y] : i.seen.low[y];
                };
                std::vector<item const*> done;
                while (limit_()) {
                    auto& holder =
                        *std::max_element(parts_.begin(), parts_.end(), [&](item& a, item& b) {
                            return upwards ? end(a) < end(b) : end(a) > end(b);
                        });
                    bool const point = !(holder.seen.low[y] < holder.seen.high[y]);
                    if (point || std::find(done.begin(), done.end(), &holder) != done.end()) break;
                    done.push_back(&holder);
                    auto const* const part = of(holder);
                    if (part == nullptr) return; // the measurements say nothing
                    double const bound = part->end_of(y, upwards);
                    bool const empty =
                        upwards ? bound < holder.seen.low[y] : bound > holder.seen.high[y];
                    if (!empty) {
                        end(holder) =
                            upwards ? std::min(end(holder), bound) : std::max(end(holder), bound);
                    } else if (parts_.size() > 1) { // no parameter in it meets all measurements
                        parts_.remove_if([&](item const& i) { return &i == &holder; });
                    }
                }
            }
        }
    }

    void collect(prediction& result) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        auto const m = cover_->outputs();
        std::vector<predicted_tube> tubes(m);
        for (std::size_t y = 0; y < m; ++y) {
            tubes[y].name = outputs_.model.about.channels[y].name;
            tubes[y].unit = outputs_.model.about.channels[y].unit;
            tubes[y].time_unit = outputs_.model.about.time_unit;
            std::vector<double> low, high;
            for (auto const& i : parts_) {
                cover_->segments(i.what, i.seen, y, low, high);
                if (tubes[y].low.empty()) {
                    tubes[y].low = low;
                    tubes[y].high = high;
                    continue;
                }
                for (std::size_t s = 0; s < low.size(); ++s) {
                    tubes[y].low[s] = std::min(tubes[y].low[s], low[s]);
                    tubes[y].high[s] = std::max(tubes[y].high[s], high[s]);
                }
            }
        }
        result.complete = true;
        std::size_t reached = result.times.size();
        for (auto const& i : parts_) {
            result.complete = result.complete && i.what.known && i.what.known->complete;
            reached = std::min(reached, i.seen.reached);
        }
        result.reached = reached == 0 ? 0 : result.times[reached - 1];
        for (std::size_t i = 0; i < problem_.initial.size(); ++i) result.states.push_back(tubes[i]);
        auto const& about = problem_.model.about.channels;
        for (std::size_t c = 0; c < about.size(); ++c) {
            result.channels.push_back(tubes[outputs_.channels[c]]);
            result.channels.back().name = about[c].name;
            result.channels.back().unit = about[c].unit;
        }
        for (auto const y : outputs_.margins) result.further.push_back(tubes[y]);
        for (auto const& tube : result.channels) { // of functions that are not defined everywhere
            result.complete =
                result.complete && std::none_of(tube.low.begin(), tube.low.end(),
                                                [](double x) { return x == -infinity; });
        }
    }

    /// Products that move no measurement by more than this share of its bound stay errors.
    static constexpr double curved_share = 0.01;
    /// How much wider than what parts reach tubes may be before the data are asked.
    static constexpr double coarse_excess = 0.2;
    /// Unknowns of programs with all products.
    static constexpr std::size_t most_oblique = 10;

    prediction_problem const& problem_;
    prediction_options options_;
    work_limit limit_;
    followed_outputs outputs_;
    std::optional<motion_cover> cover_;
    items parts_;
    bool oblique_ = false;
    int refinements_ = 0;          ///< of the grid
    std::size_t integrations_ = 0; ///< over coarser ones
};

} // namespace decision_detail

SIVID_DECL prediction predict(prediction_problem const& problem, prediction_options const& options,
                              std::vector<node_id> const& further) {
    problem.require_valid();
    return decision_detail::prediction_search(problem, options, further)();
}

SIVID_DECL void end_where_reached(prediction& found, std::string const& channel, double limit) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    auto const& tube = found.channels[index_of(found.channels, channel, "channel")];
    std::size_t first = 0;
    while (first < tube.low.size() && tube.low[first] > -limit && tube.high[first] < limit) ++first;
    if (first == tube.low.size()) return;
    auto const from = static_cast<std::ptrdiff_t>(first);
    for (auto* tubes : {&found.states, &found.channels, &found.further}) {
        for (auto& t : *tubes) {
            std::fill(t.low.begin() + from, t.low.end(), -infinity);
            std::fill(t.high.begin() + from, t.high.end(), infinity);
        }
    }
    found.complete = false;
    found.reached = std::min(found.reached, first == 0 ? 0 : found.times[(first - 1) / 2]);
    found.excess = infinity;
}

} // namespace sivid

#endif

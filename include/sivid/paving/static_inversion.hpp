// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_STATIC_INVERSION_HPP
#define SIVID_PAVING_STATIC_INVERSION_HPP

#include <sivid/number/guard.hpp>
#include <sivid/number/pack.hpp>
#include <sivid/paving/search/search_budget.hpp>
#include <sivid/paving/static/detail/static_findings.hpp>
#include <sivid/paving/static/detail/static_survey.hpp>
#include <sivid/paving/static/flat_paving.hpp>
#include <sivid/paving/static/static_judge.hpp>
#include <sivid/work_limit.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace sivid {

struct static_inversion_options {
    /// A side is not split below this share of the prior's side.
    double accuracy = 1e-3;
    /// Stop when the volume that is neither inside nor outside falls to this share of the prior's.
    double uncertain = 0;
    double seconds = 60;
    std::size_t boxes = 100'000'000;
    std::size_t memory = std::numeric_limits<std::size_t>::max(); ///< bytes, see `used_up`
    /// Only the hull of what is feasible is sought: boxes are split while they reach further, by
    /// `accuracy` of the prior's side, than the hull of points that are proved feasible. These
    /// points are `inside`, as boxes without width; what is `open` is not told apart any more.
    bool only_hulls = false;
    std::function<bool()> keep_going; ///< asked once a block; false ends the work
};

/// Set inversion for static problems: largest boxes first, with every measurement that a box's
/// parent decided left alone.
///   Boxes for which many measurements are open, or for which linear programs do much, are tested
///   one at a time (`static_survey`). Where at most 64 are left, boxes wait in blocks of flat
///   arrays and are tested eight at a time by the enclosures of their open measurements
///   (`static_judge`), then kept, dropped, or cut where their open outputs spread most.
/// @cost  about 10 to 100 ns a box for small models; time and memory O(measurements)
/// @ref  Jaulin and Walter, Automatica 29 (1993): SIVIA
template <std::size_t W = 8>
class static_inversion {
public:
    static_inversion(static_problem const& problem, static_inversion_options options)
        : program_(problem),
          samples_(problem),
          judge_(program_, samples_, problem.outliers),
          survey_(program_, samples_, problem.outliers, options.only_hulls),
          prior_(problem.prior),
          options_(std::move(options)),
          result_(problem.prior) {}
    static_inversion(static_inversion const&) = delete;
    static_inversion& operator=(static_inversion const&) = delete;

    [[nodiscard]] flat_paving operator()() {
        require_sound_environment();
        stopwatch const clock;
        work_limit const limit(options_.seconds, options_.keep_going);
        prepare();
        while (!blocks_.empty() || !boxes_.empty()) {
            if (options_.keep_going && !options_.keep_going()) {
                stop(stop_reason::cancelled);
            } else if (auto const why = used_up(options_, limit, result_.tested, bytes())) {
                stop(*why);
            } else if (!boxes_.empty() &&
                       (blocks_.empty() || boxes_.begin()->first >= blocks_.begin()->first.first)) {
                survey_one();
            } else {
                work_through();
            }
        }
        result_.asked = judge_.asked() + survey_.asked();
        result_.seconds = clock.spent();
        return std::move(result_);
    }

private:
    using block = static_block;

    /// Bytes of what waits and of the result.
    [[nodiscard]] std::size_t bytes() const {
        return alone_bytes_ + block_count_ * block::bytes(prior_.size()) + result_.inside.bytes() +
               result_.open.bytes();
    }

    void prepare() {
        for (auto const& side : prior_) {
            least_.push_back(options_.accuracy * width(side));
            thick_.push_back(side.lower() < side.upper());
            scale_.push_back(thick_.back() != 0 ? 1 / width(side) : 0);
        }
        auto all = std::make_shared<std::vector<static_samples::index> const>(samples_.all());
        static_box first{prior_, std::move(all), 0};
        uncertain_ = approximate_volume(prior_);
        allowed_ = options_.uncertain * uncertain_;
        wait(std::move(first), prior_.size() > 2);
    }

    static int size_class(double volume) { return volume > 0 ? std::ilogb(volume) / 2 : -2000; }
    /// A block with room for boxes of a volume and of a list of measurements.
    block& block_for(double volume, static_list const& measurements, std::size_t family) {
        auto& list = blocks_[{size_class(volume), family}];
        if (!list.empty() && !list.back()->full()) return *list.back();
        if (spare_.empty()) {
            list.push_back(std::make_unique<block>(prior_.size()));
            ++block_count_;
        } else {
            list.push_back(std::move(spare_.back()));
            spare_.pop_back();
        }
        list.back()->list = measurements;
        list.back()->family = family;
        list.back()->count = 0;
        return *list.back();
    }
    /// @param alone  it is not for blocks, even if few measurements are open
    void wait(static_box b, bool alone) {
        auto const volume = approximate_volume(b.set);
        if (alone || options_.only_hulls || b.open->size() > block::most_open) {
            alone_bytes_ += b.bytes();
            boxes_[size_class(volume)].push_back(std::move(b));
            return;
        }
        auto& to = block_for(volume, b.open, families_++);
        for (std::size_t j = 0; j < prior_.size(); ++j) {
            to.boxes.lower(j)[0] = b.set[j].lower();
            to.boxes.upper(j)[0] = b.set[j].upper();
        }
        to.open_all(0, b.missed);
        to.count = 1;
    }

    /// All that waits stays open.
    void stop(stop_reason why) {
        result_.reason = why;
        for (auto const& [size, list] : boxes_)
            for (auto const& b : list) result_.open.add(b.set);
        for (auto const& [size, list] : blocks_)
            for (auto const& b : list)
                for (std::size_t i = 0; i < b->count; ++i) result_.open.add(b->boxes, i);
        boxes_.clear();
        blocks_.clear();
    }
    void leave_open(box const& x) {
        result_.reason = stop_reason::accuracy_reached;
        result_.open.add(x);
    }

    [[nodiscard]] double approximate_volume(block const& b, std::size_t i) const {
        double v = 1;
        for (std::size_t j = 0; j < prior_.size(); ++j) {
            double const w = b.boxes.upper(j)[i] - b.boxes.lower(j)[i];
            v *= thick_[j] != 0 ? w : 1;
        }
        return v;
    }
    [[nodiscard]] double approximate_volume(box const& x) const {
        double v = 1;
        for (std::size_t j = 0; j < x.size(); ++j)
            v *= thick_[j] != 0 ? x[j].upper() - x[j].lower() : 1;
        return v;
    }

    /// The largest of the boxes that wait alone.
    void survey_one() {
        auto& list = boxes_.begin()->second;
        auto b = std::move(list.front());
        alone_bytes_ -= b.bytes();
        list.pop_front();
        if (list.empty()) boxes_.erase(boxes_.begin());
        if (options_.only_hulls && known_.size() > 0 && subset(b.set, known_)) {
            leave_open(b.set);
            return;
        }
        bool splittable = false;
        for (std::size_t j = 0; j < prior_.size(); ++j)
            splittable = splittable || width(b.set[j]) > 2 * least_[j];
        auto const before = approximate_volume(b.set);
        auto const found = survey_(b, !splittable);
        ++result_.tested;
        bool const open = found == box_verdict::undecided;
        uncertain_ -= before - (open ? approximate_volume(b.set) : 0);
        if (found == box_verdict::inside) {
            result_.inside.add(b.set);
            know(b.set);
        }
        if (open) {
            if (options_.only_hulls) look_for_points(b);
            split(std::move(b));
        }
        if (allowed_ > 0 && uncertain_ <= allowed_) stop(stop_reason::accuracy_reached);
    }
    void know(box const& x) { known_ = known_.size() == 0 ? x : hull(known_, x); }

    /// Feasible points: one deep inside, others between it and the corners that the programs saw.
    void look_for_points(static_box const& b) {
        auto const& points = survey_.points();
        auto const take = [&](std::vector<double> p) {
            for (std::size_t j = 0; j < p.size(); ++j) {
                if (!std::isfinite(p[j])) return false;
                p[j] = std::clamp(p[j], b.set[j].lower(), b.set[j].upper());
            }
            auto const x = point_box(p);
            if (known_.size() > 0 && subset(x, known_)) return true;
            if (!survey_.explains(b, p)) return false;
            result_.inside.add(x);
            know(x);
            return true;
        };
        auto const between = [](std::vector<double> p, std::vector<double> const& q, double share) {
            for (std::size_t j = 0; j < p.size(); ++j) p[j] += share * (q[j] - p[j]);
            return p;
        };
        auto middle = mid(b.set);
        if (!points.empty()) {
            middle = points[0];
            if (!take(middle)) {
                double weight = 1;
                for (auto const& p : points) middle = between(middle, p, 1 / weight++);
            }
        }
        if (!take(middle)) return;
        for (auto const& corner : points) {
            for (double const share : {1 - 0.25 * options_.accuracy, 0.99, 0.9, 0.5}) {
                if (take(between(middle, corner, share))) break;
            }
        }
    }

    /// Halves of a box that waited alone, or it stays open.
    void split(static_box b) {
        std::size_t side = prior_.size();
        double most = -1, widest = 0, at = 0;
        for (std::size_t j = 0; j < prior_.size(); ++j) {
            double const lo = b.set[j].lower(), hi = b.set[j].upper(), w = hi - lo;
            if (!(w > least_[j])) continue;
            double rank = survey_.slope(j) * w, cut = lo + 0.5 * w;
            if (options_.only_hulls && known_.size() > 0) {
                double const below = known_[j].lower() - lo, above = hi - known_[j].upper();
                double const beyond = std::max(below, above);
                if (!(beyond > least_[j])) continue;
                rank = beyond * scale_[j];
                // Half of what reaches beyond what is known; all of it when the box lies there.
                if (beyond < w) cut = above > below ? hi - 0.5 * above : lo + 0.5 * below;
            }
            double const share = w * scale_[j];
            if (rank > most || (rank == most && share > widest)) {
                most = rank;
                widest = share;
                at = cut;
                side = j;
            }
        }
        if (side == prior_.size() || !(b.set[side].lower() < at && at < b.set[side].upper())) {
            leave_open(b.set);
            return;
        }
        auto [low, high] = bisect(b.set, side, at);
        bool const alone = survey_.programs_helped();
        wait({std::move(low), b.open, b.missed}, alone);
        wait({std::move(high), b.open, b.missed}, alone);
    }

    /// Tests a block of the largest boxes.
    void work_through() {
        auto& list = blocks_.begin()->second;
        auto now = std::move(list.front());
        list.pop_front();
        if (list.empty()) blocks_.erase(blocks_.begin());
        now->pad(W);
        for (std::size_t i = 0; i < now->count; i += W) {
            auto const lanes = std::min(W, now->count - i);
            double before = 0;
            for (std::size_t l = 0; l < lanes; ++l) before += approximate_volume(*now, i + l);
            auto const found = judge_(*now, i);
            result_.tested += lanes;
            double after = 0;
            for (std::size_t l = 0; l < lanes; ++l) {
                auto const bit = std::uint64_t{1} << l;
                if ((found.outside & bit) != 0) continue;
                if ((found.inside & bit) != 0) {
                    result_.inside.add(now->boxes, i + l);
                    continue;
                }
                keep_core(*now, i + l, l);
                after += approximate_volume(*now, i + l);
                split(*now, i + l, l);
            }
            uncertain_ -= before - after;
            if (allowed_ > 0 && uncertain_ <= allowed_) {
                for (auto k = i + lanes; k < now->count; ++k) result_.open.add(now->boxes, k);
                stop(stop_reason::accuracy_reached);
                return;
            }
        }
        spare_.push_back(std::move(now));
    }

    /// Cuts off what is inside and keeps the core.
    void keep_core(block& b, std::size_t i, std::size_t lane) {
        for (std::size_t j = 0; j < prior_.size(); ++j) {
            double& lo = b.boxes.lower(j)[i];
            double& hi = b.boxes.upper(j)[i];
            double const from = judge_.core_lower(j, lane), to = judge_.core_upper(j, lane);
            if (lo < from) {
                double const end = std::exchange(hi, from);
                result_.inside.add(b.boxes, i);
                hi = end;
                lo = from;
            }
            if (to < hi) {
                double const begin = std::exchange(lo, to);
                result_.inside.add(b.boxes, i);
                lo = begin;
                hi = to;
            }
        }
    }

    /// Halves of box i at the end of what waits; or the box stays open.
    void split(block const& from, std::size_t i, std::size_t lane) {
        std::size_t side = prior_.size();
        double most = -1, widest = 0;
        for (std::size_t j = 0; j < prior_.size(); ++j) {
            double const w = from.boxes.upper(j)[i] - from.boxes.lower(j)[i];
            if (!(w > least_[j])) continue;
            double const rank = judge_.slope(j, lane) * w, share = w * scale_[j];
            // Where the slopes say nothing (none, or unbounded ones) the widest side.
            if (rank > most || (rank == most && share > widest)) {
                most = rank;
                widest = share;
                side = j;
            }
        }
        if (side < prior_.size()) {
            double const lo = from.boxes.lower(side)[i], hi = from.boxes.upper(side)[i];
            double const middle = lo + 0.5 * (hi - lo);
            if (lo < middle && middle < hi) {
                // Two places: blocks are even.
                auto& to = block_for(0.5 * approximate_volume(from, i), from.list, from.family);
                to.copy(from, i, to.count);
                to.copy(from, i, to.count + 1);
                to.boxes.upper(side)[to.count] = middle;
                to.boxes.lower(side)[to.count + 1] = middle;
                to.count += 2;
                return;
            }
        }
        result_.reason = stop_reason::accuracy_reached;
        result_.open.add(from.boxes, i);
    }

    static_program program_;
    static_samples samples_;
    static_judge<W> judge_;
    static_survey<W> survey_;
    box prior_;
    static_inversion_options options_;
    flat_paving result_;
    /// What waits, largest first by the binary exponent of the volume: blocks of boxes of about one
    /// size and one list, and boxes that are tested alone.
    std::map<std::pair<int, std::size_t>, std::deque<std::unique_ptr<block>>, std::greater<>>
        blocks_;
    std::map<int, std::deque<static_box>, std::greater<>> boxes_;
    std::size_t families_ = 0;
    box known_; ///< hull of what is proved inside, once there is something
    std::vector<std::unique_ptr<block>> spare_;
    std::size_t block_count_ = 0, alone_bytes_ = 0; ///< of all blocks, of boxes that wait alone
    std::vector<double> least_, scale_; ///< least width to split, 1 / width of the prior
    std::vector<char> thick_;
    double uncertain_ = 0, allowed_ = 0;
};

/// Finds the parameters p in the prior with g(t_k, p) within its bounds for all measurements k but
/// as many as may be outliers.
/// @throws std::invalid_argument  for a problem that does not fit together (it names what)
/// @throws unsound_environment    where interval arithmetic would prove nothing (`guard.hpp`)
/// @guarantee  boxes `inside` are feasible throughout; every feasible parameter of the prior lies
///   in a box, and in `hull`, and violates all that is `forced`
/// @cost  linear in the measurements, times the boxes; eight of either at a time
[[nodiscard]] inline flat_paving invert_static(static_problem const& problem,
                                               static_inversion_options options = {}) {
    auto found = static_inversion<8>(problem, options)();
    add_static_findings(problem, found, options.seconds, options.keep_going);
    return found;
}

} // namespace sivid

#endif

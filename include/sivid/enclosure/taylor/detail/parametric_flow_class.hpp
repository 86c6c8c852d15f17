// SPDX-License-Identifier: MIT
#ifndef SIVID_ENCLOSURE_TAYLOR_DETAIL_PARAMETRIC_FLOW_CLASS_HPP
#define SIVID_ENCLOSURE_TAYLOR_DETAIL_PARAMETRIC_FLOW_CLASS_HPP

/// @file
/// Sets of Taylor models along trajectories, and which steps they try: a preference but for what
/// `advance` accepts. How a step is proved: parametric_flow.hpp.

#include <sivid/compiled.hpp>
#include <sivid/enclosure/detail/required_boxes.hpp>
#include <sivid/enclosure/failure.hpp>
#include <sivid/enclosure/options.hpp>
#include <sivid/enclosure/series/detail/expansion_tail.hpp>
#include <sivid/enclosure/series/detail/power_sum.hpp>
#include <sivid/enclosure/series/detail/variation_step.hpp>
#include <sivid/enclosure/series/domain_edge.hpp>
#include <sivid/enclosure/series/expansion.hpp>
#include <sivid/enclosure/series/taylor_expansion.hpp>
#include <sivid/enclosure/set/parametric_set.hpp>
#include <sivid/enclosure/step/detail/step_length.hpp>
#include <sivid/enclosure/step/perturbed_step.hpp>
#include <sivid/model/series/detail/twofold_arithmetic.hpp>
#include <sivid/model/series/taylor_arithmetic.hpp>
#include <sivid/number/guard.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sivid {

/// Carries a family of trajectories as Taylor models in its unknowns (see `parametric_set`), one
/// proved step at a time. Stays tight over boxes in which first-order sets blow up.
///
/// One step from t over h, with s in [0,h], E the reach, \f$ x_k, V_k \f$ the Taylor coefficients
/// in time of the solution through P(q) and of the flow's derivative there (the latter over \f$
/// P(q) \pm E \f$), K and L their orders, and b(q, s) a tube:
///   centre  \f$ x(s; P) \in \sum_{k \le K} s^k x_k + s^{K+1} x_{K+1}(b) \f$
///   flow    \f$ V(s) \in \sum_{k<L} s^k V_k + s^L J_L(b) (1 + [-W, W]) \f$
/// and the tube is proved when both images lie strictly inside it. Smooth steps are first tried
/// without a tube, with what both series leave out from `expansion_tail`. Inputs with error bounds:
/// the step is that of the recorded inputs, and what the others may add (see `perturbed_step`) goes
/// into the generators.
///
/// Where nothing is unknown (a point) and roundings would cost more than the truncation that is
/// asked for, the centre is kept in twice the digits, and so are the lowest orders of its series:
/// see `sharpen`.
///
/// With lanes, W families advance together, each at its own time and with its own step. No lane's
/// proof rests on another; shared are orders, the choice of generators to keep, and which of
/// several bounds is evaluated.
/// @guarantee  after each successful step, for every q and every member of the set before, the
///             solution lies in the set after (same q), and during the step in `swept()`.
/// @tparam Model  of single families, or in lanes
/// @cost  O(nodes K^2 products of degree D in N variables) a step, as many in N + 1 variables where
///        it needs a tube
/// @ref   Makino and Berz 2003 (Taylor models for flows); Kühn 1998 (zonotopes); Zgliczynski 2002
/// (C1)
template <class Model = taylor_model<double>>
class parametric_flow {
public:
    using C = typename Model::scalar;
    using set_type = parametric_set<Model>;
    using polynomial = Model;
    using column_entry = Model;
    using tube_entry = Model;
    using shape_type = typename Model::shape_type;
    using side_by_side = lane_traits<C>;
    using mask = typename side_by_side::mask;
    static constexpr std::size_t width = side_by_side::count;

    /// @param variables  at least as many as the unknowns
    /// @param degree     of the polynomials
    parametric_flow(flow const& f, enclosure_options const& options, std::size_t variables,
                    std::size_t degree)
        : flow_(&f),
          options_(options),
          shape_(&shape_type::of(variables, degree)),
          column_shape_(&shape_type::of(variables, (degree + 1) / 2)),
          tube_shape_(&shape_type::of(variables + 1, degree >= 5   ? 3
                                                     : degree >= 2 ? 2
                                                                   : 1)),
          path_of_(*shape_, *tube_shape_),
          set_(f.states(), *shape_),
          centre_(f, options_.order + 1, variations::by_state, *shape_),
          derivative_(f, options_.order + 1, variations::by_state, *column_shape_),
          tube_(f, options_.order + 1, variations::by_state, *tube_shape_),
          centre_tail_(f, centre_),
          derivative_tail_(f, derivative_),
          observe_(f.observe(), 0, *shape_),
          parameters_(f.parameters(), Model(*shape_)),
          column_parameters_(f.parameters(), Model(*column_shape_)),
          tube_parameters_(f.parameters(), Model(*tube_shape_)),
          around_(f.states()),
          path_(f.states()),
          tube_box_(f.states()),
          swept_(f.states()),
          room_(f.states()),
          truncation_(f.states()) {
        if (options_.order < 1)
            throw std::invalid_argument("enclosure_options: order must be at least 1");
        if (f.uncertain()) perturbed_.emplace(f, *column_shape_);
        disturbed_.resize(f.states());
        order_ = std::min(order_, options_.order);
        for (auto const& r : f.at_rest()) sticking_.push_back({r.state(), &r, nullptr});
    }

    /// Starts the family of one lane; what the other lanes do goes on.
    /// @given  the unknowns have at most as many variables as the flow (checked)
    void begin(std::size_t lane, double time, box const& initial, box const& parameters);
    /// The same in the first, or only, lane.
    void begin(double time, box const& initial, box const& parameters) {
        begin(0, time, initial, parameters);
    }
    /// Goes on from what `set()` was at some step of the same family.
    /// @given  `begin` for that family (trusted)
    void resume(set_type const& set) requires(width == 1) {
        set_ = set;
        begin_sticking(0);
        flow_order_ = std::max<std::size_t>(flow_order_, options_.order / 2); // one step is all
        stale_ = true;
    }
    /// Ends the family of a lane.
    void end(std::size_t lane) { running_ = running_ & !side_by_side::only(lane); }

    /// Tries one step in every lane that runs and is before its limit. A lane whose step was too
    /// long stays where it is, and will try a shorter one.
    /// @returns  the lanes that moved, none beyond its limit
    [[nodiscard]] mask advance(C const& limit);
    /// One proved step of the only lane, at most to `limit`.
    /// @throws std::invalid_argument when `limit` is not later than `time()`
    [[nodiscard]] bool step(double limit) requires(width == 1) {
        if constexpr (width == 1) { // clang before 16 instantiates it with the class of lanes, too
            if (!(limit > set_.time) && running_)
                throw std::invalid_argument("parametric_flow: a step must go forward, not to " +
                                            nearest_text(limit));
            while (running_) {
                if (advance(limit)) return true;
            }
        }
        return false;
    }

    [[nodiscard]] mask running() const { return running_; }
    [[nodiscard]] double time(std::size_t lane = 0) const {
        return side_by_side::get(set_.time, lane);
    }
    [[nodiscard]] set_type const& set() const { return set_; }
    /// About the largest |x_i| so far: what its errors are compared with.
    [[nodiscard]] C size(std::size_t i) const {
        return side_by_side::max(set_.largest[i], C(flow_->small(i)));
    }
    [[nodiscard]] normalised_unknowns const& unknowns(std::size_t lane = 0) const {
        return *lanes_[lane].unknowns;
    }
    [[nodiscard]] std::optional<enclosure_failure> const& failure(std::size_t lane = 0) const {
        return lanes_[lane].failure;
    }
    [[nodiscard]] std::size_t steps(std::size_t lane = 0) const { return lanes_[lane].steps; }
    /// Variables and degree of the polynomials.
    [[nodiscard]] shape_type const& shape() const { return *shape_; }
    /// Those of the tubes: one variable more, the time within a step.
    [[nodiscard]] shape_type const& tube_shape() const { return *tube_shape_; }
    /// \f$ h (1 + \tau) / 2 \f$, the time since the begin of a step, as a tube has it.
    [[nodiscard]] tube_entry within_step(C const& h) const {
        return tube_entry::variable(*tube_shape_, tube_shape_->variables - 1, h * 0.5, h * 0.5);
    }
    [[nodiscard]] flow const& equations() const { return *flow_; }
    /// The outputs at the lanes' times, as functions of the unknowns.
    [[nodiscard]] std::vector<polynomial> outputs();

    /// A box that contains all states of a lane during its last proved step; without sides before
    /// the first.
    [[nodiscard]] box swept(std::size_t lane = 0) const {
        box result(lanes_[lane].steps == 0 ? 0 : swept_.size());
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = range(lane_of(swept_[i], lane));
        return result;
    }
    /// The tubes of the last proved steps themselves: for each q and \f$ \tau \in [-1, 1] \f$, the
    /// last variable, the states at \f$ t + h (1 + \tau) / 2 \f$, where h is the step's length
    /// times 1 + 4 units.
    [[nodiscard]] std::vector<tube_entry> const& swept_models() const { return swept_; }

private:
    static constexpr double up = enclosure_detail::sum_up;
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    /// n x n entries, one for each pair of states.
    using square = std::vector<C>;

    struct lane_state {
        std::optional<normalised_unknowns> unknowns;
        std::optional<enclosure_failure> failure;
        enclosure_failure why; ///< of the last rejected attempt
        std::size_t steps = 0;
        std::size_t attempts = 0; ///< since the last accepted step
        double proposed = 0;      ///< length that the coefficients suggested
        double next = 0;          ///< length to try
        double tried = 0;         ///< the last one tried since the last accepted step
        double learned = 1;
        bool free = false;      ///< neither the end of the interval nor `gentle` had a say in it
        bool held = false;      ///< by `gentle`
        bool rough = false;     ///< at a kink: the next attempt is of first order
        bool forced = false;    ///< the shortest step, although the coefficients suggest less
        bool root = false;      ///< the set touches one of 0
        bool cut = false;       ///< by a kink: the length says nothing about smooth steps
        double near = infinity; ///< about the longest step that the neighbourhood of a kink allows
        std::size_t crossing = 0; ///< steps of first order since the last smooth one
    };

    /// A state during a step of first order that the right-hand side holds between bounds.
    struct held_state {
        mask lanes{};
        C lower{}, upper{}; ///< at the end
    };

    struct held_side;

    /// A state that may stick at 0, and the flow while it does.
    struct sticking {
        std::size_t state;
        flow::resting const* equations;
        std::unique_ptr<parametric_flow> run; ///< made when it is needed
        C most = C(infinity);                 ///< the longest step to try
        C until{};                            ///< not before that time: it does not stick
    };

    /// A step that lanes try together.
    struct trial {
        mask lanes;             ///< in which it may still be proved; in the end, is proved
        std::size_t order;      ///< K; 0 at a kink
        std::size_t flow_order; ///< L
        C to{};
        C h{};        ///< not less than the length
        square w{};   ///< W, where a tube proves the step
        mask jumps{}; ///< which no V carries

        [[nodiscard]] bool smooth() const { return order > 0; }
    };
    /// What is known of a tube while it is sought.
    struct tube_bounds {
        tube_entry times;
        C power{}, flow_power{}; ///< \f$ h^{K+1}, h^L \f$, rounded up
        square base;             ///< |V - 1| by orders 1 to L - 1
        square last;             ///< \f$ h^L |J_L(b)| \f$
        std::vector<C> carried;  ///< what the series of V make of the reach
        std::vector<C> spread;   ///< the reach during the step
        std::vector<C> share;    ///< of the truncation, that is compared with what is allowed

        [[nodiscard]] C image(C const& truncation, std::size_t i) const {
            return (truncation + spread[i]) * up;
        }
    };
    /// The centre at the end of a step, its tail, and what goes into new generators.
    struct centre_image {
        std::vector<polynomial> centre;
        std::vector<C> tail, lost;
    };

    [[nodiscard]] C allowed(std::size_t i) const {
        auto const& p = set_.centre[i];
        return size(i) * options_.tolerance +
               (p.spread() + set_.reach[i]) * options_.relative_tolerance;
    }
    /// What a step across a kink may lose: a small share of what the set spans, besides what is
    /// lost anyway since the slopes differ on its two sides.
    [[nodiscard]] C allowed_at_kink(std::size_t i) const {
        auto const& p = set_.centre[i];
        return size(i) * (options_.tolerance * 10) +
               (p.spread() + set_.reach[i]) * enclosure_detail::kink_share(options_);
    }
    [[nodiscard]] double shortest(std::size_t lane) const {
        auto const& l = lanes_[lane];
        return enclosure_detail::shortest_step(
            options_, l.cut && l.crossing < enclosure_detail::crossing_steps);
    }
    /// What runs at rest know of the families is of others.
    void begin_sticking(std::size_t lane) {
        ++begun_;
        for (auto& s : sticking_) {
            side_by_side::put(s.most, lane, infinity);
            side_by_side::put(s.until, lane, -infinity);
        }
    }
    /// The run of a flow at rest, with what it has to know of the families in these lanes.
    parametric_flow& at_rest(sticking& s, mask lanes);
    /// A step of lanes in which a state sticks at 0, by the flow at rest.
    /// @param moved  receives the lanes that moved
    /// @returns      the lanes that tried
    [[nodiscard]] mask stick(mask able, C const& limit, mask& moved);
    /// Where what a flow at rest rests on holds, on a tube from `from` over h.
    [[nodiscard]] mask stays(C const& from, C const& h, std::vector<tube_entry> const& tube,
                             C& share, C& strength);
    /// Lanes of a step of first order, not yet accepted, by whose end the state has come to rest.
    [[nodiscard]] mask stops(sticking& s, trial const& t);
    /// A step in lanes at a kink that brings the state to rest, as long as that takes.
    [[nodiscard]] mask land(mask able, C const& limit);
    [[nodiscard]] mask advance_by_series(mask able, C const& limit);
    void end_worn_lanes(C const& limit);
    [[nodiscard]] trial begin_trial(mask able);
    void end_undefined_lanes(trial& t);
    void begin_attempts(std::size_t lane, double rest, bool smooth);
    [[nodiscard]] std::optional<double> target_of(std::size_t lane, double limit, bool smooth);
    void give_up(std::size_t lane);
    void learn(std::size_t lane, bool moved, std::size_t order);
    void expand(std::size_t order);
    void expand_flow(std::size_t flow_order);
    [[nodiscard]] std::pair<double, std::size_t> estimate(std::size_t lane) const;
    [[nodiscard]] double propose(std::size_t lane, double rest) const;
    [[nodiscard]] double gentle(std::size_t lane, double h) const;
    void adapt_order(mask moved, C const& h, bool clamped);
    void adapt_flow_order(mask moved, std::size_t order, std::size_t flow_order,
                          std::vector<C> const& added);
    [[nodiscard]] mask useful(mask lanes);
    void guess_tube(C const& h, std::size_t order);
    /// Bounds what the series of a step over h leave out from the sizes of their coefficients:
    /// `truncation_`, and |V| beyond the terms below `flow_order` in `derivative_tail_`.
    /// @returns the lanes in which that is proved
    [[nodiscard]] mask bound_tails(C const& h, std::size_t order, std::size_t flow_order);
    /// The lanes of `trying` whose truncation is small enough.
    /// @param slopes  at kinks: h |df_i/dx_c| over the step; empty where no derivative exists
    [[nodiscard]] mask short_enough(mask trying, C const& h, std::size_t order,
                                    std::vector<C> const& truncation, square const& slopes);
    [[nodiscard]] mask carries_well(mask trying, C const& h, std::size_t flow_order);
    /// @returns the lanes of a trial in which it is proved
    [[nodiscard]] mask attempt(trial& t);
    [[nodiscard]] mask prove_by_tails(trial& t);
    [[nodiscard]] mask prove_by_tube(trial& t);
    [[nodiscard]] tube_bounds begin_tube(trial const& t);
    void expand_tube(trial& t, tube_entry const& times);
    void bound_truncation(trial& t, tube_bounds& known);
    void bound_spread(trial& t, tube_bounds& known);
    [[nodiscard]] mask lies_inside(trial const& t, tube_bounds const& known);
    void widen_rooms(trial& t, tube_bounds const& known, mask open);
    /// Of a step of first order: bounds of the states that their own rates hold.
    void hold_states(mask trying, C const& h, tube_entry const& times);
    /// Gives them these bounds.
    void release_states(mask moved, std::vector<polynomial>& next, std::vector<C>& lost);
    /// Carries the set to the end of a step, in the lanes in which it is proved.
    void accept(trial const& t);
    [[nodiscard]] centre_image centre_at_end(trial const& t, C const& length);
    [[nodiscard]] std::vector<C> added_by_last_variation(trial const& t, C const& length) const;
    [[nodiscard]] std::vector<column_entry> flow_at_end(trial const& t, C const& length) const;
    void carry_generators(trial const& t, C const& length, std::vector<C>& lost);
    void add_perturbation(trial const& t, C const& length, std::vector<C>& lost);
    [[nodiscard]] bool is_clamped(trial const& t, C const& length) const;
    /// How many of the centre's lowest orders are worth twice the digits; a preference.
    [[nodiscard]] std::size_t sharp_orders(C const& length, std::size_t order) const;
    /// Expands the centre of a point in twice the digits, up to `orders` - 1.
    /// @returns whether that is possible
    [[nodiscard]] bool expand_sharply(std::size_t orders);
    /// One state at the end of the step, from the sharp coefficients below `orders` and the others
    /// up to `top`. Writes `next` where that is tighter.
    /// @param beyond  bound of what the series leaves out
    /// @returns what the state has beyond the constant of `next`
    template <class Coefficient>
    [[nodiscard]] C sharpen(std::size_t i, Coefficient const& coefficient, std::size_t top,
                            C const& to, std::size_t orders, C const& beyond, polynomial& next);
    /// Uncertain inputs: the lanes of a proved step for which their share is bounded as well.
    [[nodiscard]] mask perturb(mask moved, C const& to);
    /// The next attempts of these lanes are of first order.
    void meet_kink(mask lanes);
    void leave_at_kink(trial& t, mask lanes) {
        meet_kink(lanes);
        t.lanes = t.lanes & !lanes;
    }
    void reject(mask lanes, failure_reason reason, C const& shorten);
    void leave(trial& t, mask lanes, failure_reason reason, C const& shorten) {
        reject(lanes, reason, shorten);
        t.lanes = t.lanes & !lanes;
    }
    void fail(std::size_t lane, enclosure_failure why) {
        complete(why, set_, lane, *lanes_[lane].unknowns);
        lanes_[lane].failure = why;
        running_ = running_ & !side_by_side::only(lane);
    }
    /// What is not defined for some states of a lane.
    template <class Entry>
    [[nodiscard]] std::optional<domain_edge> edge(std::size_t lane, Entry const& times,
                                                  std::vector<Entry> const& x,
                                                  std::vector<Entry> const& p) const;
    /// Notes for the lanes the state whose row of a matrix is largest.
    void note_steepest(mask lanes, square const& m);

    flow const* flow_;
    enclosure_options options_;
    shape_type const *shape_, *column_shape_, *tube_shape_;
    polynomials_in_time<C> path_of_;
    set_type set_;
    expansion<polynomial> centre_;
    expansion<column_entry> derivative_;
    expansion<tube_entry> tube_;
    expansion_tail<polynomial> centre_tail_;
    expansion_tail<column_entry> derivative_tail_;
    series<polynomial> observe_;
    std::optional<perturbed_step<column_entry>> perturbed_; ///< where inputs are uncertain
    /// About how much of the reach they cause; a preference, no proof rests on it.
    std::vector<C> disturbed_;
    std::optional<expansion<twofold>> sharp_; ///< of a point, where it was needed
    bool sharp_ready_ = false;                ///< it knows the parameters
    bool sharp_pays_ = true;                  ///< it was tighter when it was last tried
    std::vector<polynomial> parameters_;
    std::vector<column_entry> column_parameters_;
    std::vector<tube_entry> tube_parameters_;
    std::vector<column_entry> around_;
    std::vector<column_entry> image_; ///< of a generator; its memory is used again
    std::vector<tube_entry> path_, tube_box_, swept_;
    std::vector<C> room_, truncation_;
    std::vector<sticking> sticking_;
    std::optional<series<tube_entry>> conditions_; ///< of a flow at rest
    mask by_rest_{};                               ///< whose last step was one at rest
    mask landing_{}; ///< whose step is as long as it takes to come to rest
    std::size_t begun_ = 0,
                known_ = 0;        ///< families begun; those whose parameters a run at rest has
    std::vector<held_state> held_; ///< of the last step of first order; else empty
    bool tails_ = false;           ///< the last attempt was proved by the tails of the series alone
    C ratio_{};                    ///< of the last attempt's truncation to what is allowed
    std::array<lane_state, width> lanes_;
    mask running_{};
    bool stale_ = true;          ///< the expansions are not those of the present sets
    bool smooth_ = true;         ///< the expansions are of full order
    std::size_t order_ = 6;      ///< K
    std::size_t flow_order_ = 3; ///< L
    std::size_t expanded_ = 0;   ///< L of `derivative_`
};

template <class Model>
void parametric_flow<Model>::begin(std::size_t lane, double time, box const& initial,
                                   box const& parameters) {
    require_sound_environment();
    if (lane >= width)
        throw std::out_of_range("parametric_flow: no lane " + std::to_string(lane) + " of " +
                                std::to_string(width) + ", counted from 0");
    enclosure_detail::require_boxes("parametric_flow", *flow_, initial, parameters);
    normalised_unknowns unknowns(initial, parameters);
    if (unknowns.variables > (shape_->degree == 0 ? 0 : shape_->variables))
        throw std::invalid_argument(
            "parametric_flow: " + std::to_string(unknowns.variables) +
            " sides of these boxes have a width, and its polynomials have " +
            std::to_string(shape_->degree == 0 ? 0 : shape_->variables) + " variables");
    end(lane);
    // Whatever the lanes held must not show: one that stands idle may decide which of several
    // bounds all lanes get.
    bool const alone = !side_by_side::any(running_);
    for (std::size_t l = 0; l < width; ++l) {
        if (l != lane && !alone) continue;
        for (std::size_t j = 0; j < parameters_.size(); ++j) {
            enclosure_detail::put(unknowns.parameters[j], l, parameters_[j]);
            enclosure_detail::put(unknowns.parameters[j], l, column_parameters_[j]);
            enclosure_detail::put(unknowns.parameters[j], l, tube_parameters_[j]);
        }
    }
    centre_.set_parameters(parameters_);
    derivative_.set_parameters(column_parameters_);
    tube_.set_parameters(tube_parameters_);
    observe_.set_parameters(parameters_);
    if (perturbed_) perturbed_->set_parameters(column_parameters_);
    for (auto& x : disturbed_) {
        if (alone) x = 0.0;
        side_by_side::put(x, lane, 0.0);
    }
    if (alone) { // a fresh start for all
        set_ = set_type(flow_->states(), *shape_);
        // Knots of sampled inputs keep steps short; what lies between them decides on the order.
        order_ = flow_->sampled_inputs().empty() ? options_.order
                                                 : std::min<std::size_t>(options_.order, 6);
        flow_order_ = 3;
    }
    set_.begin(lane, time, unknowns, alone);
    sharp_ready_ = false;
    sharp_pays_ = true;
    lanes_[lane] = lane_state{};
    lanes_[lane].unknowns.emplace(std::move(unknowns));
    begin_sticking(lane);
    running_ = running_ | side_by_side::only(lane);
    stale_ = true;
}

template <class Model>
std::vector<typename parametric_flow<Model>::polynomial> parametric_flow<Model>::outputs() {
    std::vector<polynomial> x;
    for (std::size_t i = 0; i < set_.centre.size(); ++i) {
        x.push_back(widened(set_.centre[i], set_.reach[i]));
    }
    auto const t = polynomial::constant(set_.time);
    auto const inputs = widened(input_pieces<polynomial>(*flow_, set_.time, t), *flow_,
                                input_errors(*flow_, set_.time, set_.time));
    observe_.evaluate(t, x, inputs);
    std::vector<polynomial> result;
    for (std::size_t y = 0; y < flow_->channels(); ++y) {
        auto& p = result.emplace_back(observe_.output(y, 0));
        p.r() = side_by_side::select(observe_.undefined(), C(infinity), p.r());
    }
    return result;
}

template <class Model>
void parametric_flow<Model>::expand(std::size_t order) {
    auto const through = [&](std::vector<polynomial> const& start) {
        centre_.expand(set_.time, polynomial::constant(set_.time), start,
                       std::max<std::size_t>(order, 1));
    };
    bool exact = true;
    for (auto const& x : set_.tail) exact = exact && side_by_side::all(x == C(0.0));
    if (exact) {
        through(set_.centre);
    } else {
        auto start = set_.centre;
        for (std::size_t i = 0; i < start.size(); ++i) {
            start[i] = widened(start[i], side_by_side::abs(set_.tail[i]));
        }
        through(start);
    }
    smooth_ = order > 0;
    stale_ = false;
    expanded_ = 0;
}

template <class Model>
void parametric_flow<Model>::expand_flow(std::size_t flow_order) {
    for (std::size_t i = 0; i < set_.centre.size(); ++i) {
        around_[i] = widened(converted(set_.centre[i], *column_shape_), set_.reach[i]);
    }
    derivative_.expand_with_variations(set_.time, column_entry::constant(set_.time), around_,
                                       flow_order - 1);
    expanded_ = flow_order;
}

/// The step length at which a coefficient reaches what is allowed, and its state.
template <class Model>
std::pair<double, std::size_t> parametric_flow<Model>::estimate(std::size_t lane) const {
    std::pair<double, std::size_t> least{infinity, 0};
    for (std::size_t k = std::max<std::size_t>(order_, 2) - 1; k <= order_; ++k) {
        for (std::size_t i = 0; i < set_.centre.size(); ++i) {
            double const c = side_by_side::get(centre_.state(i, k).norm(), lane);
            if (!(c > 0) || !std::isfinite(c)) continue;
            double const h =
                enclosure_detail::length_for(side_by_side::get(allowed(i), lane), c, k);
            if (h < least.first) least = {h, i};
        }
    }
    return least;
}

/// Step length from the last coefficients; a preference, no proof rests on it.
template <class Model>
double parametric_flow<Model>::propose(std::size_t lane, double rest) const {
    double const h =
        std::min({options_.longest_step(), rest, lanes_[lane].learned * estimate(lane).first});
    // A little longer rather than once more: the length aims at a tenth of what is allowed.
    double const longer = h * std::pow(4.0, 1.0 / static_cast<double>(order_ + 1));
    if (rest <= std::min(longer, options_.longest_step())) return rest;
    return h > 0.5 * rest ? std::max(0.5 * rest, std::min(h, options_.shortest_step())) : h;
}

/// The longest step up to h that does not magnify by much what the degree of the polynomials loses.
///   What products lose beyond degree D is in the radii of the coefficients \f$ x_k \f$, so a step
///   loses \f$ \ell(h) = \sum_{k \ge 1} h^k r_k \f$. In proportion to the time that is least on
///   short steps, \f$ \ell(h)/h \to r_1 \f$; on long ones every term is magnified by norms,
///   like \f$ e^{3 h |A|} \f$. Where it is more than a step may lose, it should stay below \f$ 2 h
///   r_1 \f$. A preference, no proof rests on it.
template <class Model>
double parametric_flow<Model>::gentle(std::size_t lane, double h) const {
    if (shape_->degree == 0)
        return h; // no degree: all of it are roundings, which do not want more steps
    constexpr double most = 2, rounding = 1e-12;
    std::array<double, 64> lost{}; // the largest share of what the step may lose, for each order
    std::size_t const last = std::min(order_, lost.size() - 1);
    for (std::size_t k = 1; k <= last; ++k) {
        for (std::size_t i = 0; i < set_.centre.size(); ++i) {
            auto const& x = centre_.state(i, k);
            C const share = (x.r() - x.norm() * rounding) / allowed(i);
            lost[k] = std::max(lost[k], side_by_side::get(share, lane));
        }
    }
    while (h > options_.shortest_step()) {
        double rate = 0;
        for (std::size_t k = last; k >= 1; --k) rate = rate * h + lost[k];
        if (!(rate * h > 1 && rate > most * lost[1])) break;
        h *= 0.9;
    }
    return h;
}

/// One order more where the tolerance limits the step, one less where the end of an interval or
/// `gentle` does.
template <class Model>
void parametric_flow<Model>::adapt_order(mask moved, C const& h, bool clamped) {
    if (!clamped) {
        order_ = std::min(options_.order, order_ + 1);
        return;
    }
    if (order_ <= 2) return;
    // With one order less, the next length follows from these coefficients.
    for (std::size_t k = order_ - 2; k < order_; ++k) {
        C power = h;
        for (std::size_t j = 1; j < k; ++j) power *= h;
        for (std::size_t i = 0; i < set_.centre.size(); ++i) {
            auto const large = centre_.state(i, k).norm() * power > allowed(i) * 0.3;
            if (side_by_side::any(moved & large)) return;
        }
    }
    --order_;
}

/// The lanes whose sets still say enough; the others fail.
template <class Model>
typename parametric_flow<Model>::mask parametric_flow<Model>::useful(mask lanes) {
    for (std::size_t i = 0; i < set_.centre.size(); ++i) {
        double const limit = flow_->model().about.states[i].limit;
        // What uncertain inputs cause is no weakness of the set: no smaller box would lose less.
        C const spread = set_.centre[i].spread() + disturbed_[i];
        C const lost = set_.reach[i] - disturbed_[i];
        auto const known =
            (lost <= side_by_side::max(spread, C(0.02 * limit)) * options_.remainder_share) &
            (spread + lost <= C(options_.widest * limit));
        if (side_by_side::all(known | !lanes)) continue;
        for (std::size_t l = 0; l < width; ++l) {
            if (!side_by_side::test(lanes, l) || side_by_side::test(known, l)) continue;
            enclosure_failure why;
            why.component = i;
            why.reason = std::isfinite(side_by_side::get(lost + spread, l))
                             ? failure_reason::too_wide
                             : failure_reason::not_finite;
            fail(l, why);
            lanes = lanes & !side_by_side::only(l);
        }
    }
    return lanes;
}

template <class Model>
void parametric_flow<Model>::reject(mask lanes, failure_reason reason, C const& shorten) {
    for (std::size_t l = 0; l < width; ++l) {
        if (!side_by_side::test(lanes, l)) continue;
        lanes_[l].why.reason = reason;
        lanes_[l].next *= side_by_side::get(shorten, l);
    }
}

template <class Model>
template <class Entry>
std::optional<domain_edge> parametric_flow<Model>::edge(std::size_t lane, Entry const& times,
                                                        std::vector<Entry> const& x,
                                                        std::vector<Entry> const& p) const {
    return find_domain_edge(
        *flow_, set_.time, times, x, p,
        [lane](mask const& m) { return side_by_side::test(m, lane); },
        [lane](Entry const& a) {
            auto const b = rough_bounds(a);
            return std::pair{side_by_side::get(b.lower, lane), side_by_side::get(b.upper, lane)};
        });
}

template <class Model>
typename parametric_flow<Model>::mask parametric_flow<Model>::advance(C const& limit) {
    end_worn_lanes(limit);
    mask able = running_ & (set_.time < limit), moved{};
    by_rest_ = mask{};
    if (!sticking_.empty()) {
        able = able & !stick(able, limit, moved);
        mask const landed = land(able, limit);
        able = able & !landed;
        moved = moved | landed;
    }
    able = useful(able);
    return side_by_side::any(able) ? moved | advance_by_series(able, limit) : moved;
}

template <class Model>
typename parametric_flow<Model>::mask parametric_flow<Model>::advance_by_series(mask able,
                                                                                C const& limit) {
    auto t = begin_trial(able);
    if (stale_ || t.smooth() != smooth_) expand(t.order);
    if (expanded_ != t.flow_order) expand_flow(t.flow_order);
    end_undefined_lanes(t);
    t.to = set_.time;
    for (std::size_t l = 0; l < width; ++l) {
        if (!side_by_side::test(t.lanes, l)) continue;
        if (auto const target = target_of(l, side_by_side::get(limit, l), t.smooth())) {
            side_by_side::put(t.to, l, *target);
        } else {
            t.lanes = t.lanes & !side_by_side::only(l);
        }
    }
    if (!side_by_side::any(t.lanes)) return mask{};

    mask const tried = t.lanes;
    t.lanes = attempt(t);
    if (perturbed_ && side_by_side::any(t.lanes)) t.lanes = perturb(t.lanes, t.to);
    for (std::size_t l = 0; l < width; ++l) {
        if (side_by_side::test(tried, l)) learn(l, side_by_side::test(t.lanes, l), t.order);
    }
    if (side_by_side::any(t.lanes)) accept(t);
    return t.lanes;
}

/// Ends lanes that have made as many steps as they may; all, if the options say so.
template <class Model>
void parametric_flow<Model>::end_worn_lanes(C const& limit) {
    mask const trying = running_ & (set_.time < limit);
    bool const cancelled = options_.cancelled();
    for (std::size_t l = 0; l < width; ++l) {
        if (!side_by_side::test(trying, l)) continue;
        bool const worn = lanes_[l].attempts == 0 && lanes_[l].steps >= options_.maximum_steps;
        if (!cancelled && !worn) continue;
        enclosure_failure why;
        why.reason = cancelled ? failure_reason::cancelled : failure_reason::step_limit;
        fail(l, why);
    }
}

/// Which lanes take their turn, and by which orders.
template <class Model>
typename parametric_flow<Model>::trial parametric_flow<Model>::begin_trial(mask able) {
    // Lanes at a kink take their turn with a step of first order, in which any function may jump.
    mask rough{};
    for (std::size_t l = 0; l < width; ++l) {
        if (lanes_[l].rough) rough = rough | side_by_side::only(l);
    }
    // What uncertain inputs spread is carried by V alone, so V's truncation counts from the first
    // step on; elsewhere its order may grow from step to step.
    std::size_t const least = perturbed_ ? 8 : 1;
    flow_order_ = std::min(std::max(flow_order_, least), std::max<std::size_t>(order_, 1));
    rough = able & rough;
    if (side_by_side::any(rough)) return {rough, 0, 1};
    return {able, order_, flow_order_};
}

/// Ends the lanes whose rates are not defined at the begin of a step.
template <class Model>
void parametric_flow<Model>::end_undefined_lanes(trial& t) {
    mask undefined = derivative_.undefined();
    undefined &= !derivative_.steep();
    undefined |= centre_.undefined();
    undefined &= t.lanes;
    for (std::size_t l = 0; l < width && side_by_side::any(undefined); ++l) {
        if (!side_by_side::test(undefined, l)) continue;
        enclosure_failure why;
        why.reason = failure_reason::undefined;
        why.note(edge(l, column_entry::constant(set_.time), around_, column_parameters_));
        fail(l, why);
    }
    t.lanes = t.lanes & !undefined;
}

/// The length of a lane's first attempt.
/// @param rest  until the next knot, or the end
template <class Model>
void parametric_flow<Model>::begin_attempts(std::size_t l, double rest, bool smooth) {
    auto& lane = lanes_[l];
    // Where the set touches a root of 0, the centre's coefficients say nothing of a step.
    lane.root = smooth && side_by_side::test(derivative_.steep(), l);
    double const length = lane.root ? std::min(options_.longest_step(), rest) : propose(l, rest);
    lane.next = smooth && !lane.root ? gentle(l, length) : length;
    lane.held = lane.next < length;
    if (lane.held) lane.next = std::min(lane.next, std::max(0.5 * rest, options_.shortest_step()));
    lane.cut = lane.near < lane.next;
    if (lane.cut) lane.next = lane.near;
    lane.proposed = lane.next;
    lane.free = lane.next < 0.5 * rest && !lane.held && !lane.cut;
    lane.tried = infinity;
    lane.forced = false;
    lane.why = enclosure_failure{};
    lane.why.reason = failure_reason::minimum_step;
}

/// Where the next attempt of a lane is to end; nothing, and the lane fails, where none is left.
template <class Model>
std::optional<double> parametric_flow<Model>::target_of(std::size_t l, double limit, bool smooth) {
    auto& lane = lanes_[l];
    double const from = time(l);
    double const end = std::min(limit, flow_->next_knot(from));
    double const rest = end - from;
    if (lane.attempts == 0) begin_attempts(l, rest, smooth);
    // Before a lane gives up, it tries the shortest step itself.
    double const shortest_step = shortest(l);
    if (lane.next < shortest_step && lane.tried > shortest_step) {
        lane.next = shortest_step;
        lane.proposed = std::max(lane.proposed, lane.next);
        lane.forced = true;
    }
    double const target = lane.next >= rest ? end : from + lane.next;
    lane.tried = lane.next;
    bool const too_short = lane.next < shortest_step && target < end;
    if (++lane.attempts > 60 || !(target > from) || too_short) {
        give_up(l);
        return std::nullopt;
    }
    lane.why.until = target;
    return target;
}

template <class Model>
void parametric_flow<Model>::give_up(std::size_t l) {
    auto& lane = lanes_[l];
    if (lane.why.reason == failure_reason::undefined) {
        C const half = (C(lane.why.until) - set_.time) * 0.5;
        lane.why.note(
            edge(l,
                 tube_entry::constant(set_.time) +
                     tube_entry::variable(*tube_shape_, tube_shape_->variables - 1, half, half),
                 tube_box_, tube_parameters_));
    }
    if (lane.attempts == 1) lane.why.component = estimate(l).second; // too short to be tried
    fail(l, lane.why);
}

/// What an attempt says of a lane's next ones.
template <class Model>
void parametric_flow<Model>::learn(std::size_t l, bool moved, std::size_t order) {
    auto& lane = lanes_[l];
    bool const smooth = order > 0;
    if (!moved) {
        if (!smooth) lane.rough = false; // a shorter step may miss the kink
        lane.cut = lane.cut || lane.rough;
        return;
    }
    bool held = false; // such steps lose little, however many they are
    for (auto const& state : held_) held = held || side_by_side::test(state.lanes, l);
    lane.crossing = smooth || held ? 0 : lane.crossing + 1;
    lane.near = lane.cut ? 4 * lane.next : infinity;
    if (!lane.cut && (lane.next < lane.proposed || lane.free)) {
        // Aim at a tenth of the allowed truncation; what is too long costs a whole attempt.
        double const ratio = side_by_side::get(ratio_, l);
        double const exponent = 1 / static_cast<double>(order + 1);
        double const better =
            ratio > 0 ? std::clamp(std::pow(0.1 / ratio, exponent), 0.8, 1.1) : 1.1;
        lane.learned = std::clamp(lane.learned * lane.next / lane.proposed * better, 0.05, 4.0);
    }
    lane.attempts = 0;
    lane.rough = false;
    ++lane.steps;
}

#ifdef SIVID_COMPILED_ALIKE // its members are compiled once
extern template class parametric_flow<taylor_model<double>>;
extern template class parametric_flow<taylor_model<lanes<8>>>;
#endif

} // namespace sivid

#endif

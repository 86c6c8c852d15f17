// SPDX-License-Identifier: MIT
#ifndef SIVID_PAVING_SET_TEST_HPP
#define SIVID_PAVING_SET_TEST_HPP

#include <sivid/paving/search/exclusion_proof.hpp>
#include <sivid/paving/verdict.hpp>
#include <sivid/space/box.hpp>

#include <concepts>
#include <cstddef>
#include <memory>
#include <variant>
#include <vector>

namespace sivid {

/// What a test proved about a box.
/// @tparam Knowledge  what else it found that helps with parts of the box (a local model of the
///                    outputs, say); shared by all parts, nothing for a plain test
template <class Knowledge = std::monostate>
struct assessment {
    /// inside: all of `rest`; outside: all of the box; undecided: nothing about `rest`.
    box_verdict verdict = box_verdict::undecided;
    /// A part of the box outside which nothing of the box belongs to the set (a contraction).
    box rest;
    /// How strongly each side spreads the outputs (smear); sides with larger values are split
    /// first. Empty: the side that is widest against the prior.
    std::vector<double> smear = {};
    std::shared_ptr<Knowledge const> knowledge = nullptr;
    /// What was known did not suffice to say more; the test could learn about this box.
    bool blind = false;
    /// What learning about this box took, in a unit of the test's (feasibility_test: integrations).
    std::size_t cost = 0;
    /// What judging the box took, by the `work_clock`; set by who asks ahead of its turn.
    double work = 0;
    /// How to prove that nothing of the box but `rest` belongs to the set; may be left out.
    exclusion_proof proof = {};
};

/// A test of boxes against a set: sound verdicts and a sound contraction, completeness not
/// required.
template <class T>
concept plain_set_test = requires(T test, box const& x) {
    { test(x) } -> std::same_as<assessment<>>;
};

/// A test that hands its knowledge of a box on to the box's parts. It must be sound for any
/// knowledge that it returned for a box containing the new one, and for none (null).
template <class T>
concept learning_set_test = requires(T test, box const& x,
                                     std::shared_ptr<typename T::knowledge const> const& known) {
    { test(x, known) } -> std::same_as<assessment<typename T::knowledge>>;
};

/// A test with knowledge, too, that separates judging by what is known, which is cheap, from
/// learning, which it does for several boxes at once. Who asks about one box judges it, and learns
/// about it where the judgement is blind.
///   `judge` hands on the knowledge that it was given, or none. What both answer depends on their
///   arguments alone, bit for bit; what `learn` says of a box may depend on its companions.
template <class T>
concept batch_set_test = requires(T test, box const& x,
                                  std::shared_ptr<typename T::knowledge const> const& known,
                                  std::vector<box> const& several) {
    { test.judge(x, known) } -> std::same_as<assessment<typename T::knowledge>>;
    { test.learn(several) } -> std::same_as<std::vector<assessment<typename T::knowledge>>>;
    { test.at_once() } -> std::convertible_to<std::size_t>;
};

/// A batch test that says `static constexpr bool concurrent = true`: several threads may judge and
/// learn with it at once.
template <class T>
concept concurrent_set_test = batch_set_test<T> && bool(T::concurrent);

/// A box, and what is known of it.
template <class Knowledge>
struct posed_question {
    box const* set = nullptr;
    std::shared_ptr<Knowledge const> known = nullptr;
};

/// A batch test that is given many questions at once and has them answered elsewhere, `hands` at a
/// time: the answers are those of `judge` and `learn`, in the order of the questions.
template <class T>
concept delegating_set_test = batch_set_test<T> &&
    requires(T test, std::vector<posed_question<typename T::knowledge>> const& questions,
             std::vector<std::vector<box>> const& sets) {
    { test.judge_all(questions) } -> std::same_as<std::vector<assessment<typename T::knowledge>>>;
    {
        test.learn_all(sets)
        } -> std::same_as<std::vector<std::vector<assessment<typename T::knowledge>>>>;
    { test.hands() } -> std::convertible_to<std::size_t>;
};

/// A test that knows how many bytes its knowledge takes.
template <class T>
concept measured_set_test = requires(T test, typename T::knowledge const& known) {
    { test.bytes(known) } -> std::convertible_to<std::size_t>;
};

/// A test that may be told to stop: `cancelled()` says that what it answered last need not be what
/// it would have found with more time. Once true it stays so. Its answers are proofs all the same.
template <class T>
concept interruptible_set_test = requires(T const& test) {
    { test.cancelled() } -> std::convertible_to<bool>;
};
/// What `invert` takes: a test of one box after the other, or of many together.
template <class T>
concept set_test = plain_set_test<T> || learning_set_test<T> || batch_set_test<T>;

/// A test whose knowledge can be learnt anew from the boxes that it was learnt about, so that a
/// search can be interrupted and resumed.
template <class T>
concept resumable_set_test = plain_set_test<T> || batch_set_test<T>;

} // namespace sivid

#endif

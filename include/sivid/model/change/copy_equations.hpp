// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_CHANGE_COPY_EQUATIONS_HPP
#define SIVID_MODEL_CHANGE_COPY_EQUATIONS_HPP

#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace sivid {

/// The rates, channels, starts of added states and stated equations of a model in the graph of
/// another one, with other leaves. What is there of these in `to` is replaced, nothing else.
/// @param leaf  as for `copy_into`
/// @cost  O(size of `from`)
template <class Leaf>
void copy_equations(recorded_model& to, recorded_model const& from, Leaf&& leaf) {
    auto outputs = from.rate;
    outputs.insert(outputs.end(), from.observe.begin(), from.observe.end());
    for (auto const& a : from.added_states) outputs.push_back(a.at_begin);
    auto const images = copy_into(to.g, from.g, outputs, leaf);
    auto const channels = images.begin() + static_cast<std::ptrdiff_t>(from.rate.size());
    auto begins = channels + static_cast<std::ptrdiff_t>(from.observe.size());
    to.rate.assign(images.begin(), channels);
    to.observe.assign(channels, begins);
    to.added_states.clear();
    for (auto const& a : from.added_states) to.added_states.push_back({a.state, *begins++});
    to.stated = from.stated;
    if (!to.stated) return;
    for (auto& row : to.stated->mass) row = copy_into(to.g, from.g, row, leaf);
    to.stated->force = copy_into(to.g, from.g, to.stated->force, leaf);
}

/// States that were added to a model may begin where others of them do (a lag behind a lag): in
/// their place stands what these begin at.
inline void start_behind_others(recorded_model& model) {
    auto& all = model.added_states;
    for (auto& a : all) {
        if ((model.g.depends(a.at_begin) & on_state) == 0) continue;
        auto const seen = model.g;
        a.at_begin = copy_into(model.g, seen, {a.at_begin}, [&](node const& n, graph& to) {
                         auto const k = static_cast<std::size_t>(n.index);
                         auto const it = std::find_if(all.begin(), all.end(), [&](auto const& x) {
                             return n.op == operation::state && x.state == k;
                         });
                         return it == all.end() ? to.leaf(n.op, k) : it->at_begin;
                     }).front();
    }
}

} // namespace sivid

#endif

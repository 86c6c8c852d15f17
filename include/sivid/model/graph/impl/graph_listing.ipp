// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_IMPL_GRAPH_LISTING_IPP
#define SIVID_MODEL_GRAPH_IMPL_GRAPH_LISTING_IPP

#include <sivid/model/graph/graph_listing.hpp>

namespace sivid {

SIVID_DECL graph_listing::graph_listing(recorded_model const& m) : about_(&m.about), g_(&m.g) {
    for (std::size_t k = 0; k < m.about.constants.size(); ++k) constants_.push_back(k);
    list_outputs(m.rate, m.observe);
    for (auto const& a : m.added_states) {
        outputs_.push_back({m.about.states[a.state].name + "(begin)", a.at_begin});
    }
    list();
}

SIVID_DECL graph_listing::graph_listing(bound_model const& m)
    : about_(&m.about), g_(&m.g), constants_(m.parameters) {
    list_outputs(m.rate, m.observe);
    list();
}

SIVID_DECL std::string graph_listing::operand(node_id i) const {
    auto const& n = (*g_)[i];
    auto const k = static_cast<std::size_t>(n.index);
    switch (n.op) {
    case operation::literal:
        return literal_text(g_->value(n));
    case operation::time:
        return "t";
    case operation::state:
        return about_->states[k].name;
    case operation::constant:
        return about_->constants[constants_[k]].name;
    case operation::input:
        return about_->inputs[k].name;
    default:
        return "%" + std::to_string(numbers_[i]);
    }
}

SIVID_DECL std::string graph_listing::formula(node_id i) const {
    auto const& n = (*g_)[i];
    auto const a = operand(n.a);
    switch (n.op) {
    case operation::neg:
        return "-" + a;
    case operation::add:
        return a + " + " + operand(n.b);
    case operation::sub:
        return a + " - " + operand(n.b);
    case operation::mul:
        return a + " * " + operand(n.b);
    case operation::div:
        return a + " / " + operand(n.b);
    case operation::sqr:
        return a + "^2";
    case operation::pown:
        return a + "^" + std::to_string(n.index);
    default:
        return std::string(name(n.op)) + "(" + a + (is_binary(n.op) ? ", " + operand(n.b) : "") +
               ")";
    }
}

SIVID_DECL std::string graph_listing::literal_text(literal const& l) {
    using traits = interval_traits<interval>;
    double const size = traits::mag(l.enclosure);
    bool const decimal = width(l.enclosure) <= 3e-16 * size;
    return decimal ? nearest_text(l.nearest) : sivid::to_string(l.enclosure);
}

SIVID_DECL void graph_listing::list_outputs(std::vector<node_id> const& rate,
                                            std::vector<node_id> const& observe) {
    for (std::size_t i = 0; i < rate.size(); ++i) {
        outputs_.push_back({about_->states[i].name + "'", rate[i]});
    }
    for (std::size_t y = 0; y < observe.size(); ++y) {
        outputs_.push_back({"y." + about_->channels[y].name, observe[y]});
    }
}

SIVID_DECL void graph_listing::list() {
    std::vector<node_id> roots;
    for (auto const& o : outputs_) roots.push_back(o.value);
    auto const needed = reachable(*g_, roots);
    auto const evaluated = operands_of(*g_, roots);
    std::vector<std::size_t> uses(g_->size(), 0);
    for (auto const i : roots) ++uses[i];
    for (std::size_t k = 0; k < g_->size(); ++k) {
        auto const& n = g_->nodes()[k];
        if (!needed[k] || is_leaf(n.op)) continue;
        ++uses[n.a];
        if (is_binary(n.op)) ++uses[n.b];
    }
    numbers_.assign(g_->size(), 0);
    for (std::size_t k = 0; k < g_->size(); ++k) {
        if (!needed[k]) continue;
        auto const i = static_cast<node_id>(k);
        line l;
        l.id = i;
        l.uses = uses[k];
        l.part = part_of(g_->depends(i));
        l.companion = !evaluated[k];
        if (!is_leaf((*g_)[i].op)) l.number = numbers_[k] = ++operations_;
        lines_.push_back(l);
    }
}

} // namespace sivid

#endif

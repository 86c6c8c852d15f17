// SPDX-License-Identifier: MIT
#ifndef SIVID_MODEL_GRAPH_GRAPH_LISTING_HPP
#define SIVID_MODEL_GRAPH_GRAPH_LISTING_HPP

#include <sivid/compiled.hpp>
#include <sivid/model/bound_model.hpp>
#include <sivid/model/graph/rewrite.hpp>
#include <sivid/model/model.hpp>
#include <sivid/number/decimal_output.hpp>
#include <sivid/number/text/nearest_text.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sivid {

/// How often the value of a node has to be computed.
enum class graph_part {
    fixed,      ///< once: literals alone
    parameters, ///< once for each box of parameters: constants of the model alone
    inputs,     ///< once for each scenario: time and inputs alone
    both,       ///< inputs and constants, but no state
    states      ///< along each trajectory
};

[[nodiscard]] constexpr graph_part part_of(std::uint8_t depends) {
    if ((depends & on_state) != 0) return graph_part::states;
    bool const parameters = (depends & on_constant) != 0;
    bool const inputs = (depends & (on_input | on_time)) != 0;
    if (parameters && inputs) return graph_part::both;
    return parameters ? graph_part::parameters : inputs ? graph_part::inputs : graph_part::fixed;
}

[[nodiscard]] constexpr std::string_view to_string(graph_part p) {
    constexpr std::array<std::string_view, 5> names{"fixed", "parameters only", "inputs only",
                                                    "inputs and parameters", "states"};
    return names[static_cast<std::size_t>(p)];
}

/// The operations that some outputs of a graph need, in the order of evaluation, with the names of
/// the model: what `describe` and `to_dot` show. Refers to the model it was made of.
class graph_listing {
public:
    struct output {
        std::string name; ///< "u'" for a rate, "y.u" for a channel
        node_id value = 0;
    };
    struct line {
        node_id id = 0;
        std::size_t number = 0; ///< from 1, of an operation; leaves have none
        std::size_t uses = 0;   ///< by operations and outputs
        graph_part part = graph_part::states;
        bool companion = false; ///< only the series of another operation need it
    };

    explicit graph_listing(recorded_model const& m);
    explicit graph_listing(bound_model const& m);

    [[nodiscard]] model_description const& about() const { return *about_; }
    [[nodiscard]] graph const& nodes() const { return *g_; }
    [[nodiscard]] std::vector<output> const& outputs() const { return outputs_; }
    /// Leaves and operations, operands first.
    [[nodiscard]] std::vector<line> const& lines() const { return lines_; }
    [[nodiscard]] std::size_t operations() const { return operations_; }
    [[nodiscard]] std::size_t operations(graph_part part) const {
        std::size_t n = 0;
        for (auto const& l : lines_) n += l.number > 0 && l.part == part ? 1 : 0;
        return n;
    }
    [[nodiscard]] std::size_t shared() const {
        std::size_t n = 0;
        for (auto const& l : lines_) n += l.number > 0 && l.uses > 1 ? 1 : 0;
        return n;
    }

    /// A leaf by its name, an operation by its number: "Ff", "2.5", "%7".
    [[nodiscard]] std::string operand(node_id i) const;
    /// The operation as a formula of its operands: "Ff / %7", "sin(psi)".
    [[nodiscard]] std::string formula(node_id i) const;

    /// A literal as it was presumably written: its shortest decimal; in brackets when it is more
    /// uncertain than a decimal is.
    [[nodiscard]] static std::string literal_text(literal const& l);

private:
    void list_outputs(std::vector<node_id> const& rate, std::vector<node_id> const& observe);
    void list();

    model_description const* about_;
    graph const* g_;
    std::vector<std::size_t> constants_; ///< index of a constant leaf among the model's constants
    std::vector<output> outputs_;
    std::vector<line> lines_;
    std::vector<std::size_t> numbers_;
    std::size_t operations_ = 0;
};

} // namespace sivid

#ifndef SIVID_COMPILED
#include <sivid/model/graph/impl/graph_listing.ipp>
#endif

#endif

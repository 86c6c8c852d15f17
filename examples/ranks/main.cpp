// SPDX-License-Identifier: MIT
// One identification on several ranks: mpirun -n 4 several_ranks
#include <sivid/cluster/mpi_world.hpp>
#include <sivid/number/decimal_output.hpp>

#include <iostream>

using namespace sivid;

struct cooling {
    static constexpr auto name = "cooling";
    static constexpr auto states = sivid::states({{"T", "K", 1000}});
    static constexpr auto inputs = no_inputs;
    static constexpr auto channels = sivid::channels({{"T", "K"}});
    static constexpr auto constants = sivid::constants({{"k", "1/s", 1_dec}});
    template <class T>
    vec<T, 1> rate(T const&, vec<T, 1> const& x, vec<T, 1> const& c, vec<T, 0> const&) const {
        return {-1 * c[0] * x[0]};
    }
    template <class T>
    vec<T, 1> observe(T const&, vec<T, 1> const& x, vec<T, 1> const&, vec<T, 0> const&) const {
        return x;
    }
};

int main(int argc, char** argv) {
    experiment cup;
    cup.name = "cup";
    cup.initial = {hull(59_dec, 61_dec)};
    cup.measurements = {{1, 0, hull(36_dec, 38_dec)}, {3, 0, hull(14_dec, 15_dec)}};
    identification_problem const problem{
        record_model<cooling>(), {{"k"}, {}}, {hull(0.1_dec, 2_dec)}, {cup}};
    identify_options const options;
    cluster::mpi_world world(argc, argv);
    cluster::traffic spent;
    if (auto const found = world.identify(problem, options, "", spent)) // on rank 0
        std::cout << to_string(found->verdict) << ": k in " << to_string(found->hull[0]) << '\n';
}

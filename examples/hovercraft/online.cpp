// SPDX-License-Identifier: MIT
#include "online.hpp"

#include <sivid/report/number_text.hpp>

#include <algorithm>
#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace hovercraft_example {

namespace {

using sivid::report::outward_text;

void write_line(std::ostream& lines, double time, sivid::online_update const& now,
                sivid::identification_problem const& problem) {
    lines << "  t = " << sivid::report::given_text(time) << " " << problem.model.about.time_unit
          << ", " << now.samples << " samples, " << sivid::report::duration_text(now.seconds)
          << ": " << to_string(now.verdict);
    for (std::size_t j = 0; j < now.hull.size() && now.live > 0; ++j) {
        lines << ", " << problem.choice.unknown[j] << " " << outward_text(now.hull[j]);
    }
    for (auto const& c : now.combinations) {
        lines << ", " << c.what.formula << " " << outward_text(c.hull);
    }
    if (now.integrations > 0) lines << " (" << now.integrations << " runs from the begin)";
    lines << std::endl; // as it happens
}

} // namespace

sivid::identification identify_online(sivid::identification_problem problem,
                                      sivid::online_options options, sivid::work_limit limit,
                                      std::function<bool()> const& stopped, std::ostream& lines) {
    options.test = sivid::limited(std::move(options.test), limit);
    std::vector<sivid::online_sample> samples;
    for (std::size_t e = 0; e < problem.experiments.size(); ++e) {
        for (auto const& m : std::exchange(problem.experiments[e].measurements, {})) {
            samples.push_back({e, m});
        }
    }
    std::stable_sort(samples.begin(), samples.end(),
                     [](auto const& a, auto const& b) { return a.what.time < b.what.time; });
    sivid::online_identification online(std::move(problem), options);
    double longest = 0, total = 0;
    std::size_t updates = 0;
    std::optional<sivid::stop_reason> cut;
    for (auto from = samples.begin(); from != samples.end();) {
        double time = from->what.time;
        if (!limit()) {
            // What is said at the end is of all measurements: the others come together.
            cut = stopped() ? sivid::stop_reason::cancelled : sivid::stop_reason::time_budget;
            lines << "  " << to_string(*cut) << ": the other " << samples.end() - from
                  << " measurements at once" << std::endl;
            limit.allow(0.4);
            time = samples.back().what.time;
        }
        auto const until = std::find_if(from, samples.end(),
                                        [&](auto const& s) { return !cut && s.what.time != time; });
        auto const& now = online.add({from, until});
        write_line(lines, time, now, online.problem());
        longest = std::max(longest, now.seconds);
        total += now.seconds;
        ++updates;
        from = until;
    }
    lines << "  " << updates << " updates, the longest took "
          << sivid::report::duration_text(longest) << ", all together "
          << sivid::report::duration_text(total) << std::endl;
    auto found = online.result();
    if (cut && found.verdict != sivid::verdict::inconsistent) found.reason = *cut;
    return found;
}

} // namespace hovercraft_example

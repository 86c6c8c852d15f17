// SPDX-License-Identifier: MIT
// servo_axis diagnose on the real record, as a user runs it.
#include "io/support.hpp"
#include "support/catch.hpp"
#include "support/child_program.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <string>

namespace fs = std::filesystem;
using io_support::temporary_folder;
using support::run_program;
using support::text_of;

namespace {

fs::path real_record() { return fs::path{SIVID_MEASURED_DATA} / "emps"; }

nlohmann::json const* cause_of(nlohmann::json const& d, nlohmann::json effects) {
    for (auto const& c : d["causes"]) {
        auto own = c["effects"];
        std::sort(own.begin(), own.end());
        std::sort(effects.begin(), effects.end());
        if (own == effects) return &c;
    }
    return nullptr;
}

} // namespace

TEST_CASE("the real axis: offset and friction explain most, the direction the rest",
          "[.long][measured]") {
    if (!fs::exists(real_record() / "validation_200Hz.csv"))
        SIVID_SKIP("no EMPS records in '" << real_record().string()
                                          << "' (see docs/servo_axis.md)");
    temporary_folder const folder;
    auto const out = folder.path() / "out";
#ifdef SIVID_SANITIZED
    auto const patience = "1200";
#else
    auto const patience = "200";
#endif
    REQUIRE(run_program(SERVO_AXIS_PROGRAM, {"diagnose", real_record().string(), "--quiet",
                                             "--budget", patience, "--out", out.string()})
                .code == 0);
    auto const d = nlohmann::json::parse(text_of(out / "diagnosis.json"));
    CHECK(d["gap"]["verdict"] == "certified");
    CHECK(d["where"][0]["name"] == "force balance");
    // An estimate: no relation is proved, since under this prior the model's own rate may vary by
    // more than the declared variation that a proof would need.
    CHECK(d["where"][0]["proved"] == false);
    CHECK(d["answer"]["kind"] == "effects");
    auto const* const all = cause_of(d, {"dry_friction", "offset", "directional_friction"});
    REQUIRE(all != nullptr);
    CHECK((*all)["verdict"] == "explains");
    auto const fitted = [&](nlohmann::json effects) -> double {
        auto const* c = cause_of(d, std::move(effects));
        return c == nullptr ? 0.0 : (*c)["fitted_inflation"].get<double>();
    };
    double const base = d["gap"]["inflation"][1];
    CHECK(fitted({"dry_friction"}) > 0.6 * base);
    CHECK(fitted({"offset"}) > 0.6 * base);
    CHECK(fitted({"dry_friction", "offset"}) < 0.25 * base);
    CHECK(fitted({"dry_friction", "offset"}) > 2);
    // Least squares over 1 s: 6.23 mm and 1.39 mm on the validation record.
    auto const& kept = d["causes"][0]["holdout"];
    CHECK(kept["rmse_before"]["q"] < 1.1 * 6.23e-3);
    CHECK(kept["rmse_after"]["q"] < 1.1 * 1.39e-3);
    auto const page = text_of(out / "report.html");
    CHECK_THAT(page, ContainsSubstring("an offset that is missing"));
    CHECK_THAT(page, ContainsSubstring("How the verdict depends on the bound"));
    CHECK_THAT(page, ContainsSubstring("Beside the literature"));
}

TEST_CASE("a diagnosis without a record is refused", "[servo_axis]") {
    temporary_folder const folder;
    auto const r =
        run_program(SERVO_AXIS_PROGRAM, {"diagnose", (folder.path() / "nowhere").string(), "--out",
                                         (folder.path() / "out").string()});
    CHECK(r.code == 2);
    CHECK_THAT(r.err, ContainsSubstring("nowhere"));
    CHECK_FALSE(fs::exists(folder.path() / "out"));
}

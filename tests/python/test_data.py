# SPDX-License-Identifier: MIT
"""Arrays and frames as data sets: the checks and messages of the importer, with column and row."""
import json

import numpy as np
import pandas

import sivid
from support import GROWTH, HOVERCRAFT, Case, growth_data, growth_frame

MODEL = sivid.Model.read(GROWTH)


class Frames(Case):
    def written(self, data, model=MODEL):
        """dataset.json and the table of measurements."""
        folder = data.write(model, self.folder / "data")
        stated = json.loads((folder / "dataset.json").read_text())
        name = stated["scenarios"][0]["name"]
        return stated, (folder / f"{name}.measurements.csv").read_text()

    def test_all_that_has_columns_is_a_frame(self):
        frame = growth_frame()
        _, table = self.written(growth_data(frame=frame))
        records = np.zeros(len(frame["t"]), [("t", float), ("mass", float)])
        records["t"], records["mass"] = frame["t"], frame["mass"]
        for same in (
            pandas.DataFrame(frame),
            pandas.DataFrame(frame).set_index("t"),
            records,
            {k: list(v) for k, v in frame.items()},
            pandas.DataFrame(frame).convert_dtypes(),
        ):
            with self.subTest(type(same)):
                self.assertEqual(self.written(growth_data(frame=same))[1], table)

    def test_a_reading_is_the_double_that_it_is(self):
        frame = {"t": [0.1, 0.2], "mass": np.array([0.1, 0.3])}
        _, table = self.written(growth_data(frame=frame))
        # The time as it was meant, 30 digits of the reading, and what is cut in the bound.
        self.assertEqual(table.splitlines()[1], "360,0.100000000000000005551115123125,0.0200000001")
        _, table = self.written(growth_data(frame={"t": [1, 2], "mass": [3, 4]}))
        self.assertEqual(table.splitlines()[1], "3600,3,0.02")  # in seconds: the model's hours are its reader's

    def test_bounds_are_numbers_columns_or_proposed(self):
        frame = {**growth_frame(), "sigma": np.full(17, 0.5)}
        self.assertIn(",0.0300000001\n", self.written(growth_data(outputs={"x": ("mass", 0.03)}))[1])
        self.assertIn(",0.500000001\n", self.written(growth_data(frame=frame, outputs={"x": ("mass", "sigma")}))[1])
        data = growth_data(outputs={"x": {"column": "mass", "error": "0.25", "factor": 2}})
        self.assertIn(",0.25", self.written(data)[1])
        self.assertEqual([b["bound"] for b in data.bounds], [""])  # stated
        self.assertTrue(all(c["rests_on"] for c in data.bounds[0]["candidates"]))
        self.refused("can be proposed", lambda: self.written(growth_data(outputs={"x": ("mass", "propose")})))
        self.refused("needs the bound of its error", lambda: growth_data(outputs={"x": "mass"}), TypeError)
        self.refused("positive", lambda: self.written(growth_data(outputs={"x": ("mass", 0)})))

    def test_no_reading_is_no_measurement(self):
        frame = growth_frame()
        frame["mass"][3] = np.nan
        data = growth_data(frame=frame)
        self.assertEqual(len(self.written(data)[1].splitlines()), 17)
        self.assertIn("no reading", data.protocol)

    def test_wrong_columns_are_refused_with_column_and_row(self):
        def refused(words, **columns):
            frame = {**growth_frame(), **columns}
            self.refused(words, lambda: self.written(growth_data(frame=frame)))
            self.assertFalse((self.folder / "data").exists())

        t = growth_frame()["t"]
        refused(["line 5", "mass", "infinite"], mass=np.where(t == 2, np.inf, 0.5))
        refused(["line 5", "(t)"], t=np.where(t == 2, 0.25, t))
        refused(["'t' has 17 numbers, 'mass' has 16"], mass=t[1:])
        refused(["line 5", "that of line 4", "same_time"], t=np.where(t == 2, 1.5, t))
        refused(["'mass'", "no full real matrix of numbers"], mass=np.array(["a"] * 17))
        refused(["'mass'", "17x1"], mass=t.reshape(17, 1))
        self.refused("no variable 'weight'", lambda: self.written(growth_data(outputs={"x": ("weight", 0.1)})))
        self.refused("no variable 'time'", lambda: self.written(growth_data(time="time")))

    def test_one_of_several_readings_at_a_time_may_count(self):
        frame = growth_frame()
        frame["t"][4] = 1.5
        _, table = self.written(growth_data(frame=frame, same_time="last"))
        self.assertEqual(len(table.splitlines()), 17)

    def test_headings_with_brackets(self):
        frame = {"t (h)": growth_frame()["t"], "mass (g/L)": growth_frame()["mass"]}
        _, table = self.written(growth_data(frame=frame, time="t (h)", outputs={"x": ("mass (g/L)", "0.02")}))
        self.assertEqual(len(table.splitlines()), 18)

    def test_datetimes_count_from_the_first(self):
        frame = growth_frame()
        for zone in (None, "Europe/Paris"):
            frame["t"] = pandas.Series(pandas.date_range("2026-03-01 12:00", periods=17, freq="30min", tz=zone))
            for rows in (pandas.DataFrame(frame), pandas.DataFrame(frame).set_index("t")):
                _, table = self.written(growth_data(frame=rows))
                self.assertEqual([row.split(",")[0] for row in table.splitlines()[1:4]], ["0", "1800", "3600"])

    def test_whole_numbers_keep_their_digits(self):
        stamps = pandas.Series([2**60 + 10**9 * k for k in range(17)])
        for t in (stamps, stamps.astype("Int64"), stamps.to_numpy(np.uint64)):
            frame = {"t": t, "mass": pandas.Series(growth_frame()["mass"])}
            data = growth_data(frame=frame, time={"column": "t", "unit": "ns", "offset": "first"})
            self.assertEqual([row.split(",")[0] for row in self.written(data)[1].splitlines()[1:4]], ["0", "1", "2"])
        lost = stamps.astype("Int64")
        lost[3] = None
        self.refused("beyond 2^53", lambda: growth_data(frame={"t": lost, "mass": growth_frame()["mass"]}))
        few = pandas.Series([1, None, 3] * 6, dtype="Int64")[:17]
        _, table = self.written(growth_data(frame={"t": growth_frame()["t"], "mass": few}))
        self.assertEqual(len(table.splitlines()), 12)

    def test_time_spans_count_from_zero(self):
        frame = {"t": pandas.to_timedelta(growth_frame()["t"] + 1, unit="h"), "mass": growth_frame()["mass"]}
        _, table = self.written(growth_data(frame=frame))
        self.assertEqual([row.split(",")[0] for row in table.splitlines()[1:3]], ["3600", "5400"])

    def test_records_together(self):
        both = growth_data() + growth_data(name="second", role="holdout")
        stated, _ = self.written(both)
        self.assertEqual(
            [(s["name"], s["role"]) for s in stated["scenarios"]], [("record", "fit"), ("second", "holdout")]
        )
        self.refused("different outliers", lambda: growth_data() + growth_data(outliers=0.1), ValueError)

    def test_inputs_starts_and_priors(self):
        model = sivid.Model.read(HOVERCRAFT)
        t = np.linspace(0, 1, 11)
        frame = {"t": t, "rotor": 50 + 0 * t, "rudder": 0.1 * t, "speed": 3.6 * (2 + 0 * t)}
        data = sivid.Data(
            frame,
            inputs={"W": "rotor", "delta": ("rudder", 0.001)},
            outputs={"u": {"column": "speed", "unit": "km/h", "error": "0.1"}},
            initial={"u": 2, "v": (0, 0.1)},
            parameters={"Sv": ("0.2", "0.25")},
            fixed={"m": "1.3"},
            interpolation="hold",
        )
        stated, _ = self.written(data, model)
        self.assertEqual(stated["parameters"], {"Sv": {"prior": [0.2, 0.25]}})
        self.assertEqual(stated["fixed"], {"m": 1.3})
        self.assertEqual(stated["scenarios"][0]["initial"], {"u": [2, 2], "v": [0, 0.1]})
        self.assertEqual(stated["scenarios"][0]["interpolation"], "hold")
        self.assertEqual(stated["channel_units"], {"u": "km/h"})
        self.assertIn("delta_err", (self.folder / "data/record.inputs.csv").read_text())
        self.refused(
            "inputs",
            lambda: sivid.identify(
                model, sivid.Data(frame, outputs={"u": ("speed", 1)}, parameters={"Sv": (0.2, 0.25)})
            ),
        )

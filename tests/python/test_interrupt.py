# SPDX-License-Identifier: MIT
"""Ctrl-C, progress, threads: the interpreter goes on while a search runs."""
import os
import signal
import threading
import time

import sivid
from support import GROWTH, H3, HOVERCRAFT, Case, growth_data

ENDLESS = {"accuracy": 1e-9, "budget": 300}


class Interrupts(Case):
    def test_ctrl_c_keeps_what_is_proved(self):
        threading.Timer(3, os.kill, (os.getpid(), signal.SIGINT)).start()
        began = time.monotonic()
        with self.assertRaises(KeyboardInterrupt) as caught:
            sivid.identify(sivid.Model.read(GROWTH), growth_data(), **ENDLESS)
        self.assertLess(time.monotonic() - began, 150)
        found = caught.exception.result
        self.assertEqual(found.stop_reason, "cancelled")
        self.assertGreater(len(found.boxes("pending")[0]) + len(found.boxes("undecided")[0]), 0)
        self.assertEqual(found.verdict, "consistent")
        self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)
        # And the next search is not stopped.
        self.assertEqual(
            sivid.identify(sivid.Model.read(GROWTH), growth_data(), budget=60, accuracy=0.1).verdict, "consistent"
        )

    def test_handlers_of_ones_own_may_raise(self):
        def late(*_):
            raise TimeoutError("late")

        before = signal.signal(signal.SIGALRM, late)
        signal.alarm(2)
        try:
            with self.assertRaises(TimeoutError) as caught:
                sivid.identify(sivid.Model.read(GROWTH), growth_data(), **ENDLESS)
            self.assertEqual(caught.exception.result.stop_reason, "cancelled")
        finally:
            signal.signal(signal.SIGALRM, before)

    def test_a_search_that_was_stopped_goes_on(self):
        options = {"out": self.folder / "out", "checkpoint": 0.2, **ENDLESS}
        threading.Timer(3, os.kill, (os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            sivid.identify(sivid.Model.read(HOVERCRAFT), H3, **options)
        lines = []
        again = sivid.identify(
            sivid.Model.read(HOVERCRAFT), H3, **{**options, "budget": 3}, resume=True, progress=lines.append
        )
        self.assertTrue(any("resuming after" in line for line in lines), lines)
        self.assertEqual(again.verdict, "consistent")

    def test_progress_is_lines_of_text(self):
        lines = []
        sivid.identify(sivid.Model.read(GROWTH), growth_data(), budget=2, accuracy=1e-9, progress=lines.append)
        self.assertTrue(any("boxes" in line and " s " in line for line in lines), lines)

    def test_what_progress_raises_ends_the_search(self):
        def fails(_):
            raise RuntimeError("enough")

        with self.assertRaises(RuntimeError) as caught:
            sivid.identify(sivid.Model.read(GROWTH), growth_data(), progress=fails, **ENDLESS)
        self.assertEqual(str(caught.exception), "enough")

    def test_other_threads_go_on(self):
        count, stop = [0], threading.Event()

        def counting():
            while not stop.wait(0.01):
                count[0] += 1

        thread = threading.Thread(target=counting)
        thread.start()
        sivid.identify(sivid.Model.read(GROWTH), growth_data(), budget=2, accuracy=1e-9)
        stop.set()
        thread.join()
        self.assertGreater(count[0], 20)

    def test_commands_of_several_threads_take_turns(self):
        found = []

        def one():
            found.append(sivid.identify(sivid.Model.read(GROWTH), growth_data(), budget=60, accuracy=0.2))

        threads = [threading.Thread(target=one) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual({f.hull.tobytes() for f in found}, {found[0].hull.tobytes()})
        for f in found:
            self.assertEqual(f.text.count("culture: consistent"), 1)

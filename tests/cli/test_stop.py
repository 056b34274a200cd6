# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C: what is complete is kept and marked, quickly; a second one kills."""
import os
import signal
import subprocess
import sys
import time

from program import PROGRAM, ProgramTest, main

# Minutes of work.
LONG = ["simulate", "--surface", "gaussian", "--size", "256", "--jitter", "50000", "--resolution",
        "32", "-o", "r.asperity"]

# Seconds: the promise is 0.1 to stop tracing; saving and a loaded machine take theirs.
SOON = 2.0


class Stop(ProgramTest):
    def start(self, *arguments, **options):
        process = subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, **options)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.kill)
        return process

    def start_tracing(self):
        """Returns once the surface is made: its line is printed before the light is shot."""
        process = self.start(*LONG)
        self.assertIn("surface:", process.stdout.readline())
        return process

    def test_long_runs_say_first_what_they_spend_their_time_on(self):
        for options, words in ((["--alpha", "0.3"], "rays in each of 15 directions; fewer --rays"),
                               (["--alpha", "30"], "steep")):
            process = self.start(*LONG, *options)
            self.assertIn("surface:", process.stdout.readline())
            said = process.stdout.readline()
            self.assertRegex(said, r"^about \d+ min: ")
            self.assertIn(words, said)
            if words == "steep":
                self.assertIn("a smaller --alpha or --bounces", process.stdout.readline())
            process.kill()
        # A short one does not
        self.assertNotIn(" min: ", self.passes(*LONG[:5], "--rays", "100000", *LONG[7:]))

    def test_an_export_ends_and_leaves_no_file(self):
        process = self.start("export", "ggx:alpha=0.3", "-o", "x.bsdf", "--format",
                             "rgl:n=400,theta=128")
        time.sleep(0.7)
        asked = time.monotonic()
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)
        self.assertLess(time.monotonic() - asked, SOON)
        self.assertEqual(process.returncode, 130, err)
        if "nothing is written" in err:
            self.assert_files()
        else:  # a quick machine was reading it back
            self.assertIn("the file is whole", err)
            self.assert_files("x.bsdf")

    def test_keeps_what_is_complete(self):
        for wish in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with self.subTest(wish):
                process = self.start_tracing()
                time.sleep(3)
                asked = time.monotonic()
                process.send_signal(wish)
                out, err = process.communicate(timeout=60)
                self.assertLess(time.monotonic() - asked, SOON)
                self.assertEqual(process.returncode, 130, err)
                self.assertIn("wrote r.asperity (partial)", out)
                self.assert_files("r.asperity")
                info = self.json_of("info", "r.asperity")
                self.assertTrue(info["stopped"])
                self.assertTrue(info["notes"])
                self.assertGreaterEqual(len(info["layers"]), 1)
                os.remove("r.asperity")

    def test_what_was_ignored_stays_ignored(self):
        process = self.start(*LONG, preexec_fn=lambda: [
            signal.signal(wish, signal.SIG_IGN) for wish in (signal.SIGINT, signal.SIGHUP)])
        self.assertIn("surface:", process.stdout.readline())
        for wish in (signal.SIGINT, signal.SIGHUP):
            process.send_signal(wish)
        time.sleep(0.5)
        self.assertIsNone(process.poll())
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)

    def test_before_anything_is_complete(self):
        process = self.start_tracing()
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, err)
        if "nothing is written" in err:
            self.assert_files()

    def test_while_the_surface_is_made(self):
        process = self.start("surface", "ggx", "--size", "2048", "-o", "s.gsf")
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        self.assertEqual(err.count("\n"), 1, err)
        self.assert_files()

    def test_table_is_cut_short_too(self):
        """The comparison with a model must not keep the user waiting."""
        process = self.start(*LONG[:-2], "--resolution", "512")
        process.stdout.readline()
        time.sleep(3)
        asked = time.monotonic()
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        self.assertLess(time.monotonic() - asked, 2 * SOON)


if __name__ == "__main__":
    sys.exit(main())

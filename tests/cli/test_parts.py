# SPDX-License-Identifier: Apache-2.0
"""A measurement killed, resumed, refined, divided and merged: the checksum is always the same."""
import os
import random
import signal
import subprocess
import time

from program import PROGRAM, ProgramTest, main, run

# A few seconds of one thread, in batches of some milliseconds.
WORK = ["simulate", "--surface", "gaussian:alpha=0.3,size=128", "--theta", "0,40,75", "--material",
        "Au", "--resolution", "64", "--jitter", "1500", "--batches", "64"]


class Parts(ProgramTest):
    def checksum(self, *arguments):
        return self.json_of(*arguments)["checksum"]

    def killed(self, seconds, *arguments):
        """Runs, and kills it after so many seconds; whether it was alive until then."""
        process = subprocess.Popen([PROGRAM, *arguments], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        try:
            process.wait(timeout=seconds)
            return False
        except subprocess.TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            process.wait()
            return True

    def test_killed_at_any_moment_it_goes_on(self):
        random.seed(1)
        for refining in ([], ["--until", "0.03%,60%"]):
            work = [*WORK, *refining]
            whole = self.checksum(*work)
            file = f"r{len(refining)}.asperity"
            begin = time.monotonic()
            self.passes(*work, "-o", "timed.asperity")
            usual = time.monotonic() - begin
            kills = 0
            for k in range(8):
                threads = ["--threads", str(1 + k % 2)]
                kills += self.killed(random.uniform(0.05, 0.22) * usual, *work, *threads, "-o", file,
                                     "--resume", "--checkpoint", "0.01")
            self.assertGreater(kills, 5)
            self.assertTrue(os.path.exists(file + ".checkpoint"))
            self.assertEqual(self.checksum(*work, "-o", file, "--resume"), whole)
            self.assert_files(*{"timed.asperity", "r0.asperity", file})

    def test_stopped_it_goes_on_from_what_was_written(self):
        whole = self.checksum(*WORK)
        process = subprocess.Popen([PROGRAM, *WORK, "--threads", "1", "-o", "r.asperity"],
                                   stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.assertIn("surface:", process.stdout.readline())
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        process.communicate()
        if process.returncode == 130:
            self.assert_files("r.asperity")
        out = self.passes(*WORK, "-o", "r.asperity", "--resume")
        self.assertIn("going on from r.asperity: ", out)
        self.assertIn("checksum " + whole, out)

    def test_without_a_checkpoint_it_says_so(self):
        small = ["simulate", "--surface", "flat:size=16", "--theta", "30", "-o", "r.asperity"]
        self.assertIn("there is no r.asperity.checkpoint: starting from the beginning",
                      self.passes(*small, "--resume"))

    def test_a_checkpoint_that_will_be_lost_is_named(self):
        small = ["simulate", "--surface", "flat:size=16", "--theta", "30", "-o"]
        self.passes(*small, "r.asperity.checkpoint")
        warning = "warning: r.asperity.checkpoint of a run that did not end will be replaced"
        done = run(*small, "r.asperity", "--quiet")
        self.assertEqual(done.returncode, 0)
        self.assertIn(warning, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1)
        self.assert_files("r.asperity")
        self.assertEqual(run(*small, "r.asperity", "--quiet").stderr, "")

    def test_parts_in_any_order(self):
        whole = self.checksum(*WORK)
        files = []
        for k in range(1, 8):
            files.append(f"part{k}.asperity")
            out = self.passes(*WORK, "--threads", str(1 + k % 2), "--part", f"{k}/7", "-o",
                              files[-1])
            self.assertNotIn("stopped", out)
        for order in (files, files[::-1], files[3:] + files[:3]):
            self.assertEqual(self.checksum("merge", *order, "-o", "whole.asperity"), whole)
        info = self.json_of("info", "whole.asperity")
        self.assertEqual((info["notes"], info["stopped"]), ([], False))

        self.fails(3, "merge", *files[:4], *files[5:], "-o", "x.asperity",
                   saying="part 5/7 is missing")
        self.fails(3, "merge", *files, files[2], "-o", "x.asperity",
                   saying="part3.asperity: batches ")
        self.passes(*WORK, "--seed", "2", "--part", "5/7", "-o", "other.asperity")
        self.fails(3, "merge", *files[:4], "other.asperity", *files[5:], "-o", "x.asperity",
                   saying="other.asperity: it is of another experiment: seed is 2 there and 1 here")
        self.fails(3, "refine", files[0], "--until", "0.1%", saying="merge the parts first")
        # A part is no result, and says what it is
        self.assertIn("part 1 of 7", self.passes("info", files[0]))

    def test_a_class_of_surfaces_is_divided_and_refined(self):
        work = [*WORK[:WORK.index("--jitter")], "--surfaces", "24", "--jitter", "24"]
        whole = self.json_of(*work)
        layer = whole["layers"][0]
        self.assertEqual((whole["experiment"]["surfaces"], layer["surfaces"]), (24, 24))
        self.assertGreater(layer["share_of_rays"]["cells"], 0)
        self.assertLess(layer["share_of_rays"]["cells"], 0.5)
        self.assertLess(layer["albedo_stderr_rays"][0], layer["albedo_stderr"][0])
        auto = self.json_of(*work[:-4], "--surfaces", "auto", "--jitter", "24")
        self.assertEqual(auto["checksum"], whole["checksum"])
        self.assertNotIn("share_of_rays", self.json_of(*work, "--surfaces", "1")["layers"][0])

        files = []
        for k in range(1, 4):
            files.append(f"part{k}.asperity")
            self.passes(*work, "--threads", str(k), "--part", f"{k}/3", "-o", files[-1])
        self.assertEqual(self.checksum("merge", *files, "-o", "whole.asperity"), whole["checksum"])
        told = self.json_of("info", "whole.asperity")["layers"][0]
        self.assertEqual(told["share_of_rays"], layer["share_of_rays"])
        self.assertIn("24 surfaces; of the squared errors the rays make",
                      self.passes("info", "whole.asperity"))
        self.passes(*work, "--surface-seed", "2", "--part", "3/3", "-o", "other.asperity")
        self.fails(3, "merge", *files[:2], "other.asperity", "-o", "x.asperity",
                   saying="surface-seed is 2 there and 1 here")
        self.passes(*work, "--surfaces", "12", "--part", "3/3", "-o", "fewer.asperity")
        self.fails(3, "merge", *files[:2], "fewer.asperity", "-o", "x.asperity",
                   saying="surfaces is 12 there and 24 here")

        at_once = self.checksum(*work, "--until", "0.1%,90%")
        self.passes("refine", "whole.asperity", "--until", "0.1%,90%")
        refined = self.json_of("info", "whole.asperity")
        self.assertEqual(refined["checksum"], at_once)
        self.assertGreater(max(layer["surfaces"] for layer in refined["layers"]), 24)

    def test_a_finished_result_is_refined(self):
        at_once = self.checksum(*WORK, "--until", "0.03%,60%")
        self.passes(*WORK, "-o", "r.asperity")
        # Without a checkpoint --resume begins with the result
        out = self.passes("refine", "r.asperity", "--until", "0.03%,60%", "--resume")
        self.assertIn("checksum " + at_once, out)
        self.assert_files("r.asperity")
        self.fails(2, "refine", "r.asperity", "--until", "0.1%",
                   saying="it was measured until 0.03%,60% already")
        self.fails(2, "refine", "r.asperity", saying="refine needs --until")

    def test_a_checkpoint_of_other_options_is_refused(self):
        process = subprocess.Popen([PROGRAM, *WORK, "--jitter", "50000", "-o", "r.asperity",
                                    "--checkpoint", "0.1"], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
        end = time.monotonic() + 60
        while not os.path.exists("r.asperity.checkpoint") and time.monotonic() < end:
            time.sleep(0.02)
        process.kill()
        process.wait()
        self.assertTrue(os.path.exists("r.asperity.checkpoint"))
        self.fails(3, *WORK, "-o", "r.asperity", "--resume", saying="jitter is 50000 there and 1500")
        self.fails(3, *WORK, "--jitter", "50000", "--until", "1%", "-o", "r.asperity", "--resume",
                   saying="another --until")
        self.fails(2, *WORK, "--resume", saying="needs -o FILE")
        self.fails(2, *WORK, "--part", "8/7", "-o", "r.asperity", saying="'8' is not a whole number")
        self.fails(2, *WORK, "--part", "2", "-o", "r.asperity", saying="is not K/N")
        self.fails(2, *WORK, "--part", "1/2", "--until", "1%", "-o", "r.asperity",
                   saying="leave --until out")


if __name__ == "__main__":
    main()

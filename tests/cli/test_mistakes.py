# SPDX-License-Identifier: Apache-2.0
"""What beginners type. Each mistake is answered in one line that names the cure, with the right exit
code, and leaves no file behind."""
import os
import re
import subprocess
import sys

from program import SMALL, ProgramTest, main

# What was typed, the exit code, and the cure that the answer has to name.
MISTAKES = [
    # the verb
    ("simualte", 2, "did you mean simulate?"),
    ("gaussian --alpha 0.3", 2, "did you mean asperity surface gaussian?"),
    ("metal.asperity", 2, "did you mean asperity info metal.asperity?"),
    ("--alpha 0.3 simulate", 2, "'--alpha' stands before the verb"),
    ("--alpha 0.3", 2, "the verb comes first"),
    ("help simulte", 2, "did you mean simulate?"),
    # the order, words without dashes
    ("simulate gaussian", 2, "did you mean --surface gaussian?"),
    ("simulate heights.gsf", 2, "did you mean --surface heights.gsf?"),
    ("simulate alpha 0.3", 2, "did you mean --alpha?"),
    ("simulate -size 64", 2, "did you mean --size?"),
    ("simulate --theta 30 60", 2, "stand together: 0,30,60"),
    ("simulate --until 1 percent", 2, "1%"),
    ("render metal.asperity -o a.png", 2, "did you mean --brdf metal.asperity?"),
    ("info metal.asperity other", 2, "asperity help info"),
    # an option misspelt, or of another verb or kind
    ("simulate --surface gaussian --alpa 0.3", 2, "did you mean --alpha?"),
    ("info metal.asperity --jason", 2, "did you mean --json?"),
    ("surface gaussian --theta 30", 2, "asperity simulate has it"),
    ("simulate --surface gaussian --roughness 0.2", 2, "it is for thesis"),
    ("simulate --surface thesis --alpha 0.3", 2, "it is for gaussian, ggx"),
    ("surface gaussian --look normals", 2, "it is for --png"),
    ("render --model sphere --exposure 1 -o a.exr", 2, "it is for a PNG"),
    ("export metal.asperity -o x.csv --colour-map grey", 2, "-o X.png"),
    ("render --camera-position 0,0,2 --camera panorama --width 8 --height 8 -o a.png", 2,
     "--width 8 --height 4"),
    # a name misspelt
    ("simulate --surface gausian", 2, "did you mean gaussian?"),
    ("simulate --surface gaussian:alpa=0.3", 2, "did you mean alpha?"),
    ("simulate --material gold", 2, "did you mean Au?"),
    ("simulate --material au", 2, "did you mean Au?"),
    ("simulate --fresnel schlik", 2, "did you mean schlick?"),
    ("render --model kont -o a.png", 2, "did you mean knot?"),
    ("render --brdf cook-torance:roughness=0.3 -o a.png", 4, "did you mean cook-torrance?"),
    ("render --brdf ggx:alfa=0.3 -o a.png", 2, "did you mean alpha?"),
    ("export metal.asperity -o x.png --colour-map virids", 2, "did you mean viridis?"),
    # a name that belongs elsewhere
    ("simulate --fresnel Au", 2, "did you mean --material Au?"),
    ("simulate --fresnel gold", 2, "did you mean --material Au?"),
    ("simulate --fresnel 0.04", 2, "did you mean --f0 0.04?"),
    ("simulate --material conductor", 2, "did you mean --fresnel conductor?"),
    ("simulate --material 1.5", 2, "did you mean --ior 1.5?"),
    ("simulate --ior Au", 2, "did you mean --material Au?"),
    ("simulate --surface Au", 2, "did you mean --material Au?"),
    ("simulate --surface ggx:alpha=0.3,material=Au", 2, "did you mean --material Au?"),
    ("surface ggx:alpha=0.3,material=Au", 2, "asperity simulate takes it: --material Au"),
    ("simulate --material heights.gsf", 2, "did you mean --surface heights.gsf?"),
    ("simulate --detector gaussian", 2, "did you mean --surface gaussian?"),
    ("simulate --config gaussian", 4, "did you mean --surface gaussian?"),
    ("gloss Au", 2, "did you mean --material Au?"),
    ("render --brdf Au -o a.png", 4, "--brdf ggx:alpha=0.3,material=Au"),
    ("render --brdf gaussian:alpha=0.3 -o a.png", 4,
     "asperity simulate --surface gaussian:alpha=0.3"),
    ("render --model ggx:alpha=0.3 -o a.png", 2, "did you mean --brdf ggx:alpha=0.3?"),
    ("render --light sphere -o a.png", 2, "did you mean --model sphere?"),
    ("fit gaussian", 4, "asperity simulate --surface gaussian"),
    ("fit metal.asperity --model Au", 2, "--model ggx:material=Au"),
    ("fit metal.asperity --model chi2", 2, "did you mean --metric chi2?"),
    ("fit metal.asperity --metric ggx", 2, "did you mean --model ggx?"),
    ("fit metal.asperity --reflectance schlick", 2, "did you mean f0?"),
    ("export metal.asperity -o x.bsdf --format mitsuba", 2, "did you mean rgl or merl?"),
    ("export metal.asperity -o x.xml --format bsdf", 2, "did you mean rgl or zemax or lighttools?"),
    ("export metal.asperity -o x.png --scale viridis", 2, "did you mean --colour-map viridis?"),
    ("export gaussian -o x.bsdf", 4, "asperity simulate --surface gaussian"),
    ("compare metal.asperity Au", 4, "ggx:alpha=0.3,material=Au"),
    ("info ggx:alpha=0.3", 4, "compare, export, fit, plot and render take models"),
    # a unit, a number
    ("simulate --theta 30deg", 2, "write 30, it is taken in degrees"),
    ("simulate --theta 90", 2, "below 90 degrees"),
    ("simulate --theta 0:80", 2, "such as 0:80:10"),
    ("simulate --until 1", 2, "did you mean 1%?"),
    ("simulate --material Au --wavelengths 0.55", 2, "did you mean 550?"),
    ("simulate --material Au --wavelengths 550nm", 2, "write 550, it is taken in nm"),
    ("simulate --surface gaussian --alpha 0,3", 2, "did you mean 0.3?"),
    ("simulate --f0 4%", 2, "did you mean 0.04?"),
    ("simulate --surface gaussian --correlation-length 2um", 2, "it is taken in cells"),
    ("simulate --surface gaussian,alpha=0.3", 2, "gaussian:setting=value"),
    ("render --width 512px -o a.png", 2, "write 512"),
    ("simulate --rays 100k", 2, "did you mean 100e3?"),
    ("simulate --size 64x64", 2, "did you mean 64?"),
    ("gloss --surface gaussian --geometry 45", 2, "20, 60 and 85"),
    # surfaces of a class
    ("simulate --surface heights.gsf --surfaces 4", 2, "a file holds one surface"),
    ("simulate --surface vgroove --surfaces 4", 2, "there is no seed to it"),
    ("simulate --surface gaussian --surfaces 4 --batches 8", 2, "each of the --surfaces is a batch"),
    ("simulate --surface gaussian --surfaces 9 --rays 10", 2, "at most 5 surfaces"),
    ("gloss --surface gaussian --surfaces 4", 2, "a glossmeter looks at one surface"),
    ("simulate --surface gaussian --theta 0,30 --layers auto", 2, "layers: it has no effect beside --theta"),
    # a file of another kind, or of another name
    ("info heights.gsf", 3, "it is a heightfield (gsf), not a result"),
    ("compare metal.asperity heights.gsf", 3, "asperity simulate --surface heights.gsf measures it"),
    ("simulate --surface metal.asperity", 3, "asperity info metal.asperity shows it"),
    ("simulate --surface triangle.obj", 3, "asperity render --model triangle.obj shows it"),
    ("simulate --config metal.asperity", 3, "asperity info FILE --config"),
    ("render --model heights.gsf -o a.png", 3, "asperity simulate --surface heights.gsf"),
    ("render --light picture.exr -o a.png", 2, "did you mean env:picture.exr?"),
    ("render --light env:picture.png -o a.png", 3, "asperity render -o X.exr"),
    ("compare picture.png picture.exr", 3, "asperity render -o X.exr"),
    ("sheet picture.png -o s.png", 3, "asperity render -o X.exr"),
    ("info metl.asperity", 4, "did you mean metal.asperity?"),
    ("simulate --surface heights.gfs", 4, "did you mean heights.gsf?"),
    # the output
    ("simulate -o r.exr", 2, "asperity export r.asperity -o X.exr"),
    ("simulate -o", 2, "--output needs a value"),
    ("surface gaussian -o a.png", 2, "--png draws a picture"),
    ("render -o a.jpg", 2, ".png or .exr"),
    ("merge metal.asperity", 2, "needs -o FILE"),
    ("simulate --resume", 2, "needs -o FILE"),
    ("refine metal.asperity", 2, "needs --until"),
    ("compare metal.asperity", 2, "two result files"),
]


class Mistakes(ProgramTest):
    def test_each_is_answered_with_its_cure(self):
        self.passes("surface", "gaussian", "--size", 32, "--quiet", "-o", "heights.gsf")
        self.passes("simulate", *SMALL, "--theta", 0, "--quiet", "-o", "metal.asperity")
        self.passes("render", "--model", "sphere", "--width", 8, "--height", 8, "--spp", 1,
                    "--quiet", "-o", "picture.png", "-o", "picture.exr")
        with open("triangle.obj", "w", encoding="utf-8") as file:
            file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        there = sorted(os.listdir("."))
        self.assertGreaterEqual(len(MISTAKES), 30)
        for typed, code, cure in MISTAKES:
            with self.subTest(typed):
                self.fails(code, *typed.split(), saying=cure)
                self.assert_files(*there)


class Manual(ProgramTest):
    """Manual and completion are made from the options the program has."""

    def verbs(self):
        lines = self.passes("help").split("\n\n")[2].splitlines()
        return [line.split()[0] for line in lines]

    def options(self, verb):
        text = self.passes("help", verb).split("\nExamples")[0]
        found = re.findall(r"^  (?:(-\w), |    )(--[\w-]+)", text, re.M)
        return {name for names in found for name in names if name}

    def test_every_option_has_its_entry(self):
        self.passes("reference", "--format", "man", "-o", "man/")
        self.assertEqual(sorted(os.listdir("man")),
                         sorted(["asperity.1"] + [f"asperity-{verb}.1" for verb in self.verbs()]))
        for verb in self.verbs():
            page = self.passes("reference", "--format", "man", verb)
            with open(f"man/asperity-{verb}.1", encoding="utf-8") as file:
                self.assertEqual(file.read(), page)
            for option in self.options(verb):
                self.assertIn("\\fB" + option.replace("-", "\\-") + "\\fR", page, verb)
        # A judge that is not ours: no warning of any kind
        for name in os.listdir("man"):
            done = subprocess.run(["groff", "-man", "-k", "-ww", "-Tutf8", f"man/{name}"],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=True)
            self.assertEqual(done.stderr, b"", name)
            self.assertIn(b"asperity", done.stdout)
        self.fails(2, "reference", "--format", "mann", saying="man")
        self.fails(2, "reference", "simulate", saying="--format man")

    def complete(self, *words):
        script = self.passes("reference", "--format", "bash")
        ask = (f"{script}\nCOMP_WORDS=({' '.join(repr(word) for word in words)}); "
               f"COMP_CWORD={len(words) - 1}; _asperity; printf '%s\\n' \"${{COMPREPLY[@]}}\"")
        return set(subprocess.run(["bash", "-c", ask], stdout=subprocess.PIPE, check=True,
                                  text=True).stdout.split())

    def test_bash_completes(self):
        self.assertEqual(self.complete("asperity", "sim"), {"simulate"})
        self.assertLessEqual(set(self.verbs()), self.complete("asperity", ""))
        for verb in self.verbs():
            self.assertLessEqual(self.options(verb), self.complete("asperity", verb, "-"), verb)
        self.assertEqual(self.complete("asperity", "render", "--tonemap", ""),
                         {"none", "reinhard", "aces", "thesis"})
        self.assertEqual(self.complete("asperity", "simulate", "--detector", "eq"), {"equal-area"})
        self.assertLessEqual({"lobe", "albedo", "psd"},
                             self.complete("asperity", "plot", "--kind", ""))
        self.assertEqual(self.complete("asperity", "export", "--colour-map", "v"), {"viridis"})
        self.assertEqual(self.complete("asperity", "export", "--projection", ""),
                         {"sky-map", "disk"})
        self.assertEqual(self.complete("asperity", "fit", "--model", "a"), {"abg"})
        formats = self.complete("asperity", "export", "x", "--format", "")
        self.assertLessEqual({"rgl", "merl", "klems", "rgl:colour=", "klems:basis="}, formats)
        # bash parts words at the colon, of which it replaces what stands behind
        parted = self.complete("asperity", "export", "x", "--format", "rgl", ":", "c")
        self.assertEqual(parted, {"colour="})
        self.assertLessEqual({"colour=", "n=", "theta="},
                             self.complete("asperity", "export", "x", "--format", "rgl", ":"))
        with open("gauge.gsf", "w", encoding="utf-8"):
            pass
        self.assertEqual(self.complete("asperity", "surface", "vg"), {"vgroove"})
        self.assertEqual(self.complete("asperity", "simulate", "--surface", "ga"),
                         {"gaussian", "gauge.gsf"})

    def test_zsh_is_told_every_option_and_its_names(self):
        """What the script hands to zsh's own _arguments, a line each."""
        script = self.passes("reference", "--format", "zsh")
        self.assertTrue(script.startswith("#compdef asperity\n"))
        with open("_asperity", "w", encoding="utf-8") as file:
            file.write(script)

        def told(*words):
            ask = ("_arguments() { print -rl -- \"$@\" }; _describe() { print -rl -- $verbs }; "
                   f"words=({' '.join(words)} ''); CURRENT={len(words) + 1}; source ./_asperity")
            done = subprocess.run(["zsh", "-f", "-c", ask], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, check=True, text=True)
            self.assertEqual(done.stderr, "")
            return done.stdout.splitlines()

        self.assertEqual([line.split(":")[0] for line in told("asperity")], self.verbs())
        for verb in self.verbs():
            lines = told("asperity", verb)
            named = {line.split("[")[0] for line in lines if line.startswith("-") and "[" in line}
            self.assertLessEqual(self.options(verb), named, verb)
            for line in lines[1:]:
                # an option with its text and, where it has a value, its name and what it may be
                self.assertRegex(line, r"^(-[\w-]+\[(\\.|[^\[\]:])*\]|\*)(:(\\.|[^:])*:.+)?$")
        simulate = {line.split("[")[0]: line for line in told("asperity", "simulate")}
        self.assertTrue(simulate["--material"].endswith(":NAME:(Ag Al Au Cr Cu Fe Ni Ti)"))
        self.assertIn("files:file:_files", simulate["--surface"])
        export = {line.split("[")[0]: line for line in told("asperity", "export")}
        self.assertIn(r" rgl\:colour= ", export["--format"])
        self.assertTrue(export["--scale"].endswith(":NAME:(log linear)"))


if __name__ == "__main__":
    sys.exit(main())

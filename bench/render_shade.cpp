// SPDX-License-Identifier: Apache-2.0
// What shading asks of a BRDF, in nanoseconds.
#include "averages.h"
#include "clocks.h"
#include "render_scenes.h"
#include "render_tasks.h"

#include <asperity/bsdf/models/lambert.h>
#include <asperity/bsdf/spec.h>
#include <asperity/core/random.h>

#include <fmt/format.h>

#include <memory>
#include <utility>

namespace asperity::bench {

namespace {

constexpr std::size_t kCalls = 1 << 15;
constexpr int kRepetitions = 15;

struct Call {
    Vec3 view, light;
    double u1, u2;
};

std::vector<Call> make_calls() {
    const CounterRandom random(1, 0);
    std::vector<Call> calls;
    for (std::uint64_t k = 0; k < kCalls; ++k) {
        const auto a = random.uniform2(k, 0), b = random.uniform2(k, 1), c = random.uniform2(k, 2);
        calls.push_back({sample_cosine(a[0], a[1]), sample_cosine(b[0], b[1]), c[0], c[1]});
    }
    return calls;
}

/// Median time of a call [ns]. What the calls return is added up, so that none is left out.
template <typename Body>
double nanoseconds(const std::vector<Call>& calls, Body body) {
    std::vector<double> times;
    volatile double sum = 0;
    for (int k = 0; k < kRepetitions; ++k) {
        double total = 0;
        const double begin = cpu_seconds();
        for (const Call& call : calls) total += body(call);
        times.push_back((cpu_seconds() - begin) * 1e9 / static_cast<double>(calls.size()));
        sum = sum + total;
    }
    return median(times);
}

Report run_render_shade() {
    Report report;
    report.table = fmt::format(
        "Nanoseconds a call, one thread, directions spread by a cosine\n"
        "{:<26}{:>8}{:>14}{:>8}\n",
        "BRDF", "eval", "eval and pdf", "sample");
    const std::shared_ptr<const Bsdf> measured = measured_brdf();
    const std::vector<std::pair<std::string, std::shared_ptr<const Bsdf>>> all = {
        {"lambert", parse_brdf_spec("lambert:albedo=0.5")},
        {"ggx 0.42", parse_brdf_spec("ggx:alpha=0.42")},
        {"beckmann 0.42", parse_brdf_spec("beckmann:alpha=0.42")},
        {"cook-torrance 0.65", parse_brdf_spec("cook-torrance:roughness=0.65,metallic=1")},
        {"tabulated", measured},
        {"tabulated, as rendered", simulated_brdf(*measured)}};
    const std::vector<Call> calls = make_calls();
    for (const auto& [name, brdf] : all) {
        say_next(name);
        const Material material(brdf);
        const double eval =
            nanoseconds(calls, [&](const Call& c) { return material.eval(c.view, c.light).g; });
        const double both = nanoseconds(calls, [&](const Call& c) {
            double pdf = 0;
            return material.eval_pdf(c.view, c.light, pdf).g + pdf;
        });
        const double sample = nanoseconds(calls, [&](const Call& c) {
            const auto drawn = brdf->sample(c.view, c.u1, c.u2);
            return drawn ? drawn->pdf : 0.0;
        });
        report.table += fmt::format("{:<26}{:>8.0f}{:>14.0f}{:>8.0f}\n", name, eval, both, sample);
        report.figures.push_back(
            {{"brdf", name}, {"eval_ns", eval}, {"eval_pdf_ns", both}, {"sample_ns", sample}});
    }
    return report;
}

}  // namespace

Task add_shade(CLI::App& program) {
    CLI::App* app = program.add_subcommand("shade", "evaluation and samples of each BRDF");
    return {app, [] { return run_render_shade(); }};
}

}  // namespace asperity::bench

// SPDX-License-Identifier: Apache-2.0
#include <asperity/instruments/glossmeter.h>

#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/core/random.h>
#include <asperity/gonio/batch_plan.h>
#include <asperity/gonio/experiment_params.h>
#include <asperity/surface/statistics.h>
#include <asperity/tracing/engines/plain/tracer.h>
#include <asperity/tracing/launch.h>
#include <asperity/tracing/scale.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace asperity {

namespace {

constexpr std::uint64_t kRaysAtOnce = 4096;  // between two looks at whether the run goes on
/// The random directions of the DOI are not those of an angle of the gloss.
constexpr std::uint32_t kDoiStream = 0x10000;
constexpr double kRounding = 1e-12;
/// A DOI is told where what the narrow receptor saw is known this well.
constexpr double kDoiKnown = 0.1;
/// Tells the random directions of the source from what launch points are drawn by.
constexpr std::uint32_t kSourceStream = 0x676c6f73;

/// What became of the light of a batch, in rays; by channel.
struct BatchLight {
    std::vector<double> received, aside, escaped, truncated, edge;
    std::uint64_t rays = 0;

    explicit BatchLight(std::size_t channels)
        : received(channels),
          aside(channels),
          escaped(channels),
          truncated(channels),
          edge(channels) {}
};

/// Light of one geometry.
class Glossmeter {
  public:
    Glossmeter(const Tracer& tracer, const Fresnel& fresnel, const GlossSettings& settings,
               const GlossGeometry& geometry, std::uint32_t stream)
        : tracer_(tracer),
          fresnel_(fresnel),
          settings_(settings),
          stream_(stream),
          geometry_(geometry),
          optics_(geometry_) {}

    /// Batch `index`; nothing when the run is stopped.
    std::optional<BatchLight> trace(std::uint32_t index, std::uint64_t rays, Run& run) const {
        BatchLight light(static_cast<std::size_t>(fresnel_.channels()));
        const Incidence incidence = {0, radians(geometry_.angle_deg), 0, false};
        const LaunchBatch batch(tracer_.surface(), double{tracer_.max_height()}, incidence,
                                {settings_.run.launch, rays, settings_.run.seed, stream_, index});
        std::vector<double> weight(light.received.size()), reflectance = weight;
        for (std::uint64_t k = 0; k < rays; ++k) {
            if (k % kRaysAtOnce == 0 && !run.keep_going()) return std::nullopt;
            follow(batch.launch(k).ray, (std::uint64_t{index} << 40) + k, weight, reflectance,
                   light);
        }
        light.rays = rays;
        run.advance(rays);
        return light;
    }

    GlossReading reading(const std::vector<BatchLight>& batches) const {
        GlossReading r;
        r.geometry = geometry_;
        const double glass = optics_.glass(kGlossIndex);
        for (std::size_t c = 0; c < batches.front().received.size(); ++c) {
            const auto in_units = [&](const std::vector<double> BatchLight::*account) {
                return mean(batches,
                            [&](const BatchLight& b) { return 100 / glass * (b.*account)[c]; });
            };
            r.gloss.push_back(in_units(&BatchLight::received));
            if (has_aside()) r.haze.push_back(in_units(&BatchLight::aside));
            r.reflectance.push_back(
                mean(batches, [&](const BatchLight& b) { return b.escaped[c]; }));
        }
        for (const BatchLight& b : batches) r.rays += b.rays;
        const auto share = [&](std::vector<double> BatchLight::*account) {
            double sum = 0;
            for (const BatchLight& b : batches)
                for (const double energy : b.*account) sum += energy;
            return sum / static_cast<double>(r.rays * batches.front().received.size());
        };
        r.truncated = share(&BatchLight::truncated);
        r.edge = share(&BatchLight::edge);
        return r;
    }

    DoiReading doi(const std::vector<BatchLight>& batches) const {
        DoiReading r;
        r.geometry = geometry_;
        for (const BatchLight& b : batches) r.rays += b.rays;
        for (std::size_t c = 0; c < batches.front().received.size(); ++c) {
            const WithError mirror =
                mean(batches, [&](const BatchLight& b) { return b.received[c]; });
            if (!(mirror.error < kDoiKnown * mirror.value)) return {geometry_, {}, r.rays};
            const auto aside_of = [&](const BatchLight& b) { return 0.5 * b.aside[c]; };
            const double ratio = mean(batches, aside_of).value / mirror.value;
            // The error of a ratio, to first order: that of aside - ratio * mirror over mirror
            const WithError rest = mean(batches, [&](const BatchLight& b) {
                return (aside_of(b) - ratio * b.received[c]) / mirror.value;
            });
            r.doi.push_back({100 * (1 - ratio), 100 * rest.error});
        }
        return r;
    }

  private:
    bool has_aside() const { return geometry_.aside_deg > 0; }
    /// What `light` gives of a batch, by ray, and its error, all batches counting alike.
    template <class Light>
    static WithError mean(const std::vector<BatchLight>& batches, const Light& light) {
        const auto n = static_cast<double>(batches.size());
        const auto value = [&](const BatchLight& b) {
            return light(b) / static_cast<double>(b.rays);
        };
        WithError result;
        for (const BatchLight& b : batches) result.value += value(b) / n;
        double squares = 0;
        for (const BatchLight& b : batches)
            squares += (value(b) - result.value) * (value(b) - result.value);
        result.error = std::sqrt(squares / (n * (n - 1)));
        // Batches of which each has all there is differ by the rounding of their sums alone
        if (result.error < kRounding * result.value) result.error = 0;
        return result;
    }

    void follow(Ray ray, std::uint64_t number, std::vector<double>& weight,
                std::vector<double>& reflectance, BatchLight& light) const {
        const CounterRandom random(settings_.run.seed, kSourceStream + stream_);
        const auto place = random.uniform2(number);
        const double turn = settings_.all_azimuths ? 2 * kPi * random.uniform2(number, 1)[0]
                                                   : radians(settings_.azimuth_deg);
        ray.direction = -rotate_z(optics_.source_direction(place[0], place[1]), turn);
        std::fill(weight.begin(), weight.end(), 1.0);
        const auto add = [&](std::vector<double>& account) {
            for (std::size_t c = 0; c < weight.size(); ++c) account[c] += weight[c];
        };
        for (int reflections = 0;; ++reflections) {
            RayEnd end = RayEnd::Hit;
            tracer_.trace({&ray, 1}, {&end, 1});
            if (end == RayEnd::Escaped) {
                const Vec3 wo = rotate_z(ray.direction, -turn);
                add(light.escaped);
                if (optics_.receives(wo)) add(light.received);
                if (has_aside() && optics_.receives_aside(wo)) add(light.aside);
                return;
            }
            if (end == RayEnd::Edge) return add(light.edge);
            if (end == RayEnd::Stuck || reflections == settings_.run.bounces)
                return add(light.truncated);
            const Vec3 wi = -ray.direction, wm = tracer_.normal(ray);
            ray.direction = normalize(reflect(wi, wm));
            if (fresnel_.perfect()) continue;
            fresnel_.eval(std::min(1.0, dot(wi, wm)), reflectance);
            for (std::size_t c = 0; c < weight.size(); ++c) weight[c] *= reflectance[c];
        }
    }

    const Tracer& tracer_;
    const Fresnel& fresnel_;
    const GlossSettings& settings_;
    const std::uint32_t stream_;
    const GlossGeometry geometry_;
    const GlossOptics optics_;
};

/// The error of the gloss is small enough on every channel.
bool accurate(const GlossReading& reading, double until) {
    return std::all_of(reading.gloss.begin(), reading.gloss.end(),
                       [&](const WithError& gloss) { return gloss.error <= until * gloss.value; });
}

bool accurate(const DoiReading& reading, double until) {
    return !reading.doi.empty() &&
           std::all_of(reading.doi.begin(), reading.doi.end(),
                       [&](const WithError& doi) { return doi.error <= 100 * until; });
}

/// Batches `first` .. `end`, in order; only whole ones up to the first that was stopped.
void trace_batches(const Glossmeter& meter, const BatchPlan& plan, std::uint64_t end,
                   std::vector<BatchLight>& batches, Run& run) {
    const std::uint64_t first = batches.size();
    std::vector<std::optional<BatchLight>> more(static_cast<std::size_t>(end - first));
    parallel_for(more.size(), run.threads(), [&](std::size_t k) {
        const std::uint64_t b = first + k;
        more[k] = meter.trace(static_cast<std::uint32_t>(b), plan.rays_of(b), run);
    });
    for (auto& batch : more) {
        if (!batch) return;
        batches.push_back(std::move(*batch));
    }
}

/// Batches of the plan and then as many more as it takes until `accurate` is content with them.
/// `ahead` is the run's total of rays. Notes `what` it was that stopped without.
template <class Accurate>
std::vector<BatchLight> trace_until(const Glossmeter& meter, const BatchPlan& plan,
                                    const Accurate& accurate, const std::string& what,
                                    std::uint64_t& ahead, std::vector<std::string>& notes,
                                    Run& run) {
    std::vector<BatchLight> batches;
    std::uint64_t wanted = plan.batches;
    while (batches.size() < wanted) {
        trace_batches(meter, plan, wanted, batches, run);
        if (batches.size() < 2 || run.stop_requested() || accurate(batches)) break;
        const std::uint64_t rays = meter.reading(batches).rays, more = plan.more(wanted, rays);
        if (more == 0)
            notes.push_back(fmt::format(
                "{} stopped refining at {} rays: the asked error was not reached", what, rays));
        wanted += more;
        run.set_total(ahead += more * plan.largest());
    }
    return batches;
}

const GlossReading* at_angle(const GlossReport& report, double angle_deg) {
    const auto found =
        std::find_if(report.readings.begin(), report.readings.end(),
                     [&](const GlossReading& r) { return r.geometry.angle_deg == angle_deg; });
    return found == report.readings.end() ? nullptr : &*found;
}

void tell_haze(GlossReport& report, const OpticsSettings& optics) {
    const GlossReading *steep = at_angle(report, 20), *middle = at_angle(report, 60);
    if (steep != nullptr)
        report.notes.push_back(fmt::format(
            "haze: the receptors at {} and {} degrees are taken to be as large as that at 20 "
            "degrees, {} x {}, and added: the standards' own sizes are not published openly",
            20 - steep->geometry.aside_deg, 20 + steep->geometry.aside_deg,
            steep->geometry.receptor.in_plane, steep->geometry.receptor.across));
    if (steep == nullptr || middle == nullptr || optics.fresnel != FresnelKind::Dielectric) return;
    for (std::size_t c = 0; c < steep->gloss.size(); ++c)
        report.haze_index.push_back({middle->gloss[c].value - steep->gloss[c].value,
                                     std::hypot(middle->gloss[c].error, steep->gloss[c].error)});
}

void tell_doi(GlossReport& report) {
    if (!report.doi) return;
    const GlossGeometry& geometry = report.doi->geometry;
    report.notes.push_back(
        report.doi->doi.empty()
            ? fmt::format("no DOI: of {} rays too few met the receptor of {} degrees; ask for more "
                          "rays",
                          report.doi->rays, geometry.receptor.in_plane)
            : fmt::format("DOI: the receptors {} degrees to either side are averaged; slits {} "
                          "(source) and {} degrees (receptors) long across the plane are taken",
                          geometry.aside_deg, geometry.source.across, geometry.receptor.across));
}

bool asks_doi(const GlossSettings& settings) {
    return settings.doi.source_deg != 0 || settings.doi.receptor_deg != 0;
}

void check(const GlossSettings& settings) {
    if (settings.angles_deg.empty()) throw Error(ErrorCode::Usage, "no angle is given", "geometry");
    for (const double angle : settings.angles_deg) standard_gloss_geometry(angle);
    if (asks_doi(settings)) doi_geometry(settings.doi);
    if (settings.run.until_cells > 0)
        throw Error(ErrorCode::Usage, "a glossmeter has no cells: give one error", "until");
    check_all(run_params(), settings.run);
    if (settings.run.surfaces != 1)
        throw Error(ErrorCode::Usage, "a glossmeter looks at one surface", "surfaces");
}

}  // namespace

GlossReport measure_gloss(const Heightfield& surface, const OpticsSettings& optics,
                          const GlossSettings& settings, Run& run) {
    check(settings);
    validate(surface, surface.name);
    const Fresnel fresnel(optics);
    const SurfaceStatistics figures = statistics(surface, run);
    std::vector<double> angles;
    for (const double angle : settings.angles_deg) angles.push_back(radians(angle));
    if (asks_doi(settings)) angles.push_back(radians(settings.doi.angle_deg));
    check_scale(surface, figures.min_height, figures.max_height, angles);
    const Tracer tracer(surface, run.threads());
    const BatchPlan plan(surface.cell_count(), settings.run);

    GlossReport report;
    report.channel_names = fresnel.channel_names();
    const double until = settings.run.until;
    std::uint64_t ahead = plan.rays * (settings.angles_deg.size() + (asks_doi(settings) ? 1 : 0));
    run.begin("tracing", ahead);
    for (std::uint32_t k = 0; k < settings.angles_deg.size() && !run.stop_requested(); ++k) {
        const double angle = settings.angles_deg[k];
        const Glossmeter meter(tracer, fresnel, settings, standard_gloss_geometry(angle), k);
        const auto batches = trace_until(
            meter, plan,
            [&](const auto& b) { return until <= 0 || accurate(meter.reading(b), until); },
            fmt::format("{} degrees", angle), ahead, report.notes, run);
        if (batches.size() >= 2) report.readings.push_back(meter.reading(batches));
    }
    if (asks_doi(settings) && !run.stop_requested()) {
        const Glossmeter meter(tracer, fresnel, settings, doi_geometry(settings.doi), kDoiStream);
        const auto batches = trace_until(
            meter, plan, [&](const auto& b) { return until <= 0 || accurate(meter.doi(b), until); },
            "DOI", ahead, report.notes, run);
        if (batches.size() >= 2) report.doi = meter.doi(batches);
    }
    run.end();
    tell_haze(report, optics);
    tell_doi(report);
    report.stopped = run.stop_requested();
    return report;
}

double total_integrated_scatter(double rms_height, double wavelength, double theta) {
    const double phase = 4 * kPi * rms_height * std::cos(theta) / wavelength;
    return -std::expm1(-phase * phase);
}

}  // namespace asperity

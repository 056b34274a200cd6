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
constexpr double kHazeOff = 1.9;             // degrees from 20
/// Tells the random directions of the source from what launch points are drawn by.
constexpr std::uint32_t kSourceStream = 0x676c6f73;

/// What became of the light of a batch, in rays; by channel.
struct BatchLight {
    std::vector<double> received, hazy, escaped, truncated, edge;
    std::uint64_t rays = 0;

    explicit BatchLight(std::size_t channels)
        : received(channels),
          hazy(channels),
          escaped(channels),
          truncated(channels),
          edge(channels) {}
};

/// Light of one geometry.
class Glossmeter {
  public:
    Glossmeter(const Tracer& tracer, const Fresnel& fresnel, const GlossSettings& settings,
               std::uint32_t stream)
        : tracer_(tracer),
          fresnel_(fresnel),
          settings_(settings),
          stream_(stream),
          geometry_(standard_gloss_geometry(settings.angles_deg[stream])),
          optics_(geometry_) {}

    bool has_haze() const { return geometry_.angle_deg == 20; }

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
            r.gloss.push_back(mean(batches, &BatchLight::received, c, 100 / glass));
            if (has_haze()) r.haze.push_back(mean(batches, &BatchLight::hazy, c, 100 / glass));
            r.reflectance.push_back(mean(batches, &BatchLight::escaped, c, 1));
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

  private:
    /// The figure and its error, all batches counting alike.
    static WithError mean(const std::vector<BatchLight>& batches,
                          std::vector<double> BatchLight::*account, std::size_t c, double scale) {
        const auto n = static_cast<double>(batches.size());
        const auto value = [&](const BatchLight& b) {
            return scale * (b.*account)[c] / static_cast<double>(b.rays);
        };
        WithError result;
        for (const BatchLight& b : batches) result.value += value(b) / n;
        double squares = 0;
        for (const BatchLight& b : batches)
            squares += (value(b) - result.value) * (value(b) - result.value);
        result.error = std::sqrt(squares / (n * (n - 1)));
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
                if (has_haze() &&
                    (optics_.receives(wo, kHazeOff) || optics_.receives(wo, -kHazeOff)))
                    add(light.hazy);
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
            20 - kHazeOff, 20 + kHazeOff, steep->geometry.receptor.in_plane,
            steep->geometry.receptor.across));
    if (steep == nullptr || middle == nullptr || optics.fresnel != FresnelKind::Dielectric) return;
    for (std::size_t c = 0; c < steep->gloss.size(); ++c)
        report.haze_index.push_back({middle->gloss[c].value - steep->gloss[c].value,
                                     std::hypot(middle->gloss[c].error, steep->gloss[c].error)});
}

void check(const GlossSettings& settings) {
    if (settings.angles_deg.empty()) throw Error(ErrorCode::Usage, "no angle is given", "geometry");
    for (const double angle : settings.angles_deg) standard_gloss_geometry(angle);
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
    check_scale(surface, figures.min_height, figures.max_height, angles);
    const Tracer tracer(surface, run.threads());
    const BatchPlan plan(surface.cell_count(), settings.run);

    GlossReport report;
    report.channel_names = fresnel.channel_names();
    std::uint64_t ahead = plan.rays * settings.angles_deg.size();
    run.begin("tracing", ahead);
    for (std::uint32_t k = 0; k < settings.angles_deg.size(); ++k) {
        const Glossmeter meter(tracer, fresnel, settings, k);
        std::vector<BatchLight> batches;
        std::uint64_t wanted = plan.batches;
        while (batches.size() < wanted) {
            trace_batches(meter, plan, wanted, batches, run);
            if (batches.size() < 2 || run.stop_requested()) break;
            const GlossReading so_far = meter.reading(batches);
            if (settings.run.until <= 0 || accurate(so_far, settings.run.until)) break;
            const std::uint64_t more = plan.more(wanted, so_far.rays);
            if (more == 0)
                report.notes.push_back(fmt::format(
                    "{} degrees stopped refining at {} rays: the asked error was not reached",
                    settings.angles_deg[k], so_far.rays));
            wanted += more;
            run.set_total(ahead += more * plan.largest());
        }
        if (batches.size() >= 2) report.readings.push_back(meter.reading(batches));
        if (run.stop_requested()) break;
    }
    run.end();
    tell_haze(report, optics);
    report.stopped = run.stop_requested();
    return report;
}

double total_integrated_scatter(double rms_height, double wavelength, double theta) {
    const double phase = 4 * kPi * rms_height * std::cos(theta) / wavelength;
    return -std::expm1(-phase * phase);
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/models/lambert.h>
#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/render/builtin_models.h>
#include <asperity/render/renderer.h>
#include <asperity/render/sky.h>

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace asperity {
namespace {

using Clock = std::chrono::steady_clock;

std::shared_ptr<const TracedModel> traced(const Model& model) {
    asperity::Run run(1);
    return std::make_shared<TracedModel>(model, run);
}

Material matt(double albedo) {
    return Material(std::make_shared<LambertBrdf>(std::vector<double>{albedo}));
}

ModelScene scene_of(std::shared_ptr<const TracedModel> model, Material material) {
    ModelScene scene{std::move(model), std::move(material), {}, matt(0.5), {}};
    return scene;
}

ModelScene sphere_scene(Material material) {
    Model model;
    model.name = "sphere";
    model.meshes.push_back(make_sphere(512, 256));
    model.instances.push_back({});
    return scene_of(traced(model), std::move(material));
}

/// Something of everything: a bowl on a floor under a sky, a lamp, two materials.
ModelScene rich_scene() {
    Model model = make_builtin_model("bowl");
    add_floor(model);
    ModelScene scene = scene_of(traced(model), Material(parse_brdf_spec("ggx:alpha=0.3")));
    scene.split = SplitView{Material(parse_brdf_spec("cook-torrance:roughness=0.4")), 0.4};
    scene.lights.push_back(make_light(PointLightSettings{{1, 2, 2}, 20}));
    for (auto& light : make_sky({})) scene.lights.push_back(std::move(light));
    scene.lights.push_back(make_light(ConstantLightSettings{{0.1, 0.1, 0.1}}));
    return scene;
}

const Camera kFront = look_at({0.5, 0.8, 3.2}, {0, 0, 0}, 45);

RenderSettings small(int width = 40, int height = 24) {
    RenderSettings settings;
    settings.width = width;
    settings.height = height;
    settings.spp = 4;
    return settings;
}

Film rendered(const ModelScene& scene, const Camera& camera, const RenderSettings& settings,
              int threads = 2) {
    Renderer renderer(scene, camera, settings);
    asperity::Run run(threads);
    const RenderOutcome outcome = render(renderer, run);
    EXPECT_FALSE(outcome.stopped);
    EXPECT_EQ(renderer.rays().invalid, 0u);
    return renderer.film();
}

/// Another light, which stops a run when its calls are used up.
struct Alarm final : Light {
    std::shared_ptr<const Light> light;
    Run* run = nullptr;
    mutable std::atomic<int> calls_left{0};

    std::string name() const override { return light->name(); }
    bool is_delta() const override { return light->is_delta(); }
    std::optional<LightSample> sample(Vec3 point, double u1, double u2) const override {
        if (--calls_left < 0) run->request_stop();
        return light->sample(point, u1, u2);
    }
    Rgb radiance(Vec3 direction) const override { return light->radiance(direction); }
    double pdf(Vec3 direction) const override { return light->pdf(direction); }
    Rgb background(Vec3 direction) const override { return light->background(direction); }
    double weight() const override { return light->weight(); }
};

/// Whether all pixels hold the same bits.
bool same_bits(const Film& a, const Film& b) {
    for (std::size_t k = 0; k < a.pixels().size(); ++k) {
        const Pixel &p = a.pixels()[k], &q = b.pixels()[k];
        if (!(p.mean == q.mean && p.m2 == q.m2 && p.samples == q.samples)) return false;
    }
    return a.pixels().size() == b.pixels().size();
}

double mean_luminance(const Film& film) {
    double sum = 0;
    for (const Pixel& pixel : film.pixels()) sum += luminance(pixel.mean);
    return sum / static_cast<double>(film.pixels().size());
}

/// Standard error of mean_luminance.
double error_of_mean(const Film& film) {
    double squares = 0;
    for (const Pixel& pixel : film.pixels())
        squares += pixel.standard_error() * pixel.standard_error();
    return std::sqrt(squares) / static_cast<double>(film.pixels().size());
}

TEST(Renderer, SameBitsForAnyNumberOfThreads) {
    const ModelScene scene = rich_scene();
    for (const Integrator integrator : {Integrator::Path, Integrator::Stratified}) {
        RenderSettings settings = small();
        settings.integrator = integrator;
        settings.depth = 6;
        const Film one = rendered(scene, kFront, settings, 1);
        EXPECT_GT(mean_luminance(one), 0.01);
        for (const int threads : {2, 3, 7})
            EXPECT_TRUE(same_bits(one, rendered(scene, kFront, settings, threads))) << threads;
        settings.seed = 2;
        EXPECT_FALSE(same_bits(one, rendered(scene, kFront, settings, 1)));
    }
}

TEST(Renderer, StoppedAndResumedIsTheSame) {
    const ModelScene scene = rich_scene();
    const RenderSettings settings = small(70, 50);
    const Film whole = rendered(scene, kFront, settings);

    // The same scene with a light that asks to stop when it was asked for light often enough
    auto alarm = std::make_shared<Alarm>();
    alarm->light = scene.lights[0];
    ModelScene alarmed = scene;
    alarmed.lights[0] = alarm;
    Renderer renderer(alarmed, kFront, settings);
    int stops = 0;
    while (renderer.samples() < settings.spp) {
        asperity::Run run(2);
        alarm->run = &run;
        alarm->calls_left = 1500;
        const std::uint32_t before = renderer.samples();
        const bool complete = renderer.render_pass(run);
        EXPECT_EQ(complete, renderer.samples() == before + 1);
        stops += complete ? 0 : 1;
    }
    EXPECT_GT(stops, 0);
    EXPECT_TRUE(same_bits(whole, renderer.film()));
}

TEST(Renderer, HearsAWishToStopWithinATenthOfASecond) {
    RenderSettings settings = small(1024, 1024);
    settings.spp = 1u << 24;
    Renderer renderer(rich_scene(), kFront, settings);
    asperity::Run run(2);
    Clock::time_point asked;
    std::thread user([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(150));
        asked = Clock::now();
        run.request_stop();
    });
    const RenderOutcome outcome = render(renderer, run);
    const double seconds = std::chrono::duration<double>(Clock::now() - asked).count();
    user.join();
    EXPECT_TRUE(outcome.stopped);
    // noise() of a million pixels is part of it
    EXPECT_LT(seconds, 0.1);
}

TEST(Renderer, APauseChangesNothingButTheTime) {
    RenderSettings settings = small(128, 128);
    settings.spp = 6;
    Renderer renderer(rich_scene(), kFront, settings);
    asperity::Run run(2);
    std::uint64_t standing = 0, later = 0, all = 0;
    std::thread user([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
        run.request_pause();
        std::this_thread::sleep_for(std::chrono::milliseconds(150));  // the tiles under way
        standing = run.progress().done;
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        later = run.progress().done;
        all = run.progress().total;
        run.resume();
    });
    const auto begin = Clock::now();
    const RenderOutcome outcome = render(renderer, run);
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    user.join();
    EXPECT_EQ(standing, later);
    EXPECT_LT(later, all);
    EXPECT_FALSE(outcome.stopped);
    EXPECT_LE(outcome.seconds, seconds - 0.4);
    EXPECT_TRUE(same_bits(rendered(rich_scene(), kFront, settings), renderer.film()));
}

TEST(Renderer, SplitViewIsTwoWholePictures) {
    ModelScene split = rich_scene();
    const RenderSettings settings = small();
    const Film both = rendered(split, kFront, settings);
    ModelScene left = split, right = split;
    left.split.reset();
    right.split.reset();
    right.material = split.split->right;
    const Film a = rendered(left, kFront, settings), b = rendered(right, kFront, settings);
    EXPECT_FALSE(same_bits(a, b));
    for (int y = 0; y < settings.height; ++y)
        for (int x = 0; x < settings.width; ++x) {
            // 0.4 of 40 pixels
            const Film& side = x < 16 ? a : b;
            EXPECT_EQ(both.at(x, y).mean, side.at(x, y).mean) << x << ' ' << y;
        }
}

TEST(Renderer, IntegratingSphereReflectsToAndFroExactly) {
    // In a matt sphere of radius 1 with a lamp of intensity I in its middle every point receives
    // I, and from the sphere rho times what all points receive: after n reflections a camera sees
    // rho / pi I (1 + rho + ... + rho^(n - 1)), in every pixel and without noise. The facets of
    // the mesh, 0.7 degrees wide, hide a ten thousandth of what comes from the horizon.
    constexpr double kAlbedo = 0.8, kIntensity = 2;
    ModelScene scene = sphere_scene(matt(kAlbedo));
    scene.lights.push_back(make_light(PointLightSettings{{0, 0, 0}, kIntensity}));
    const Camera camera = look_at({0.3, 0.2, 0.1}, {1, 1, 1}, 90);
    double sum = 0;
    for (int depth = 1; depth <= 4; ++depth) {
        RenderSettings settings = small();
        settings.depth = depth;
        sum += kAlbedo / kPi * kIntensity * std::pow(kAlbedo, depth - 1);
        EXPECT_NEAR(mean_luminance(rendered(scene, camera, settings)), sum, 3e-4 * sum) << depth;
        if (depth > 1) continue;
        const Film direct = rendered(scene, camera, settings);
        for (const Pixel& pixel : direct.pixels())
            ASSERT_NEAR(luminance(pixel.mean), sum, 1e-4 * sum);
    }
    // Paths that end by chance leave the mean as it is: here of all reflections
    RenderSettings settings = small();
    settings.depth = 1000;
    settings.spp = 64;
    const Film endless = rendered(scene, camera, settings);
    const double expected = kAlbedo / kPi * kIntensity / (1 - kAlbedo);
    EXPECT_NEAR(mean_luminance(endless), expected, 4 * error_of_mean(endless));
    EXPECT_LT(error_of_mean(endless), 0.01 * expected);
}

TEST(Renderer, NoLightLeaksIntoAClosedModel) {
    for (const char* name : {"ball", "knot"}) {
        ModelScene scene = scene_of(traced(make_builtin_model(name)), matt(1));
        const Bounds b = scene.model->bounds();
        scene.lights.push_back(make_light(PointLightSettings{{1, 2, 3}, 1000}));
        scene.lights.push_back(make_light(DirectionalLightSettings{{-1, -1, 0.3}, 100}));
        scene.lights.push_back(make_light(ConstantLightSettings{}));
        // Inside: just under the surface where a ray from outside meets it
        const WorldRay in{{0.02, b.centre().y + 0.3, 5}, {0, 0, -1}};
        const Hit hit = scene.model->intersect(in);
        ASSERT_TRUE(hit.found());
        const SurfacePoint point = scene.model->surface(in, hit);
        const Vec3 inside = point.position - 0.01 * point.geometric_normal;
        RenderSettings settings = small(64, 64);
        settings.depth = 4;
        const Film film =
            rendered(scene, look_at(inside, inside + Vec3{0.3, 0.9, -0.2}, 120), settings);
        for (const Pixel& pixel : film.pixels()) ASSERT_EQ(pixel.mean, Rgb{}) << name;
    }
}

TEST(Renderer, ManyLightsAreTheSumOfEach) {
    ModelScene scene = sphere_scene(Material(parse_brdf_spec("ggx:alpha=0.5")));
    RenderSettings settings = small();
    settings.depth = 1;
    settings.filter = PixelFilter::Centre;
    std::vector<std::shared_ptr<const Light>> lights;
    for (int k = 0; k < 6; ++k)
        lights.push_back(make_light(PointLightSettings{{2.0 - k, 1.0 + 0.3 * k, 2}, 1.0 + 3 * k}));
    double sum = 0, sum_of_two = 0;
    for (std::size_t k = 0; k < lights.size(); ++k) {
        scene.lights = {lights[k]};
        const double mean = mean_luminance(rendered(scene, kFront, settings));
        sum += mean;
        if (k < 2) sum_of_two += mean;
    }
    scene.lights = {lights[0], lights[1]};
    EXPECT_NEAR(mean_luminance(rendered(scene, kFront, settings)), sum_of_two, 1e-9);
    scene.lights = lights;
    settings.spp = 256;
    const Film all = rendered(scene, kFront, settings);
    EXPECT_NEAR(mean_luminance(all), sum, 4 * error_of_mean(all));
    EXPECT_LT(error_of_mean(all), 0.01 * sum);
}

TEST(Renderer, AllWaysToFindLightHaveTheSameMean) {
    ModelScene scene = rich_scene();
    RenderSettings settings = small();
    settings.spp = 96;
    settings.depth = 1;
    const auto mean_of = [&](Integrator integrator, DirectLight direct, double& error) {
        settings.integrator = integrator;
        settings.direct = direct;
        const Film film = rendered(scene, kFront, settings);
        error = error_of_mean(film);
        return mean_luminance(film);
    };
    scene.lights.erase(scene.lights.begin() + 2);  // the sun is too small to be found by chance
    double mis_error = 0;
    const double mis = mean_of(Integrator::Path, DirectLight::Mis, mis_error);
    for (const DirectLight direct : {DirectLight::LightOnly, DirectLight::BrdfOnly}) {
        double error = 0;
        const double mean = mean_of(Integrator::Path, direct, error);
        EXPECT_NEAR(mean, mis, 4 * std::hypot(error, mis_error));
    }
    double error = 0;
    const double strata = mean_of(Integrator::Stratified, DirectLight::Mis, error);
    EXPECT_NEAR(strata, mis, 4 * std::hypot(error, mis_error));
    EXPECT_LT(std::hypot(error, mis_error), 0.02 * mis);
}

TEST(Renderer, StratifiedVisitsEveryCellOnce) {
    // f = 1 / pi under light 1: over one visit to all strata the estimate is the sum of cos sin
    // over jittered cells, whose error falls with the number of cells; plain random places would
    // err by 0.5 / sqrt(256) = 0.03
    ModelScene scene = sphere_scene(matt(1));
    scene.lights.push_back(make_light(ConstantLightSettings{}));
    RenderSettings settings = small(16, 16);
    settings.integrator = Integrator::Stratified;
    settings.strata = 16;
    settings.spp = 256;
    const Camera close = look_at({0, 0, 3}, {0, 0, 0}, 10);
    double squares = 0;
    const Film film = rendered(scene, close, settings);
    for (const Pixel& pixel : film.pixels()) squares += std::pow(luminance(pixel.mean) - 1, 2);
    EXPECT_LT(std::sqrt(squares / 256), 0.005);
}

TEST(Renderer, ShowsLightsOrABackgroundBesideTheModel) {
    ModelScene scene = sphere_scene(matt(0.5));
    scene.lights.push_back(make_light(ConstantLightSettings{{0.25, 0.5, 0.75}}));
    RenderSettings settings = small();
    EXPECT_EQ(rendered(scene, kFront, settings).at(0, 0).mean, (Rgb{0.25, 0.5, 0.75}));
    settings.show_lights = false;
    settings.background = {0.5, 0.25, 0.125};
    const Film film = rendered(scene, kFront, settings);
    EXPECT_EQ(film.at(0, 0).mean, (Rgb{0.5, 0.25, 0.125}));
    EXPECT_NEAR(film.at(20, 12).mean.b / film.at(20, 12).mean.r, 3, 1e-9) << "lit as before";
    scene.lights.clear();
    EXPECT_EQ(rendered(scene, kFront, settings).at(20, 12).mean, Rgb{}) << "no light";
}

TEST(Renderer, CountsItsRays) {
    ModelScene scene = sphere_scene(matt(0.5));
    scene.lights.push_back(make_light(PointLightSettings{{0, 0, 5}, 10}));
    RenderSettings settings = small(32, 32);
    settings.depth = 1;
    settings.spp = 1;
    settings.filter = PixelFilter::Centre;
    Renderer renderer(scene, look_at({0, 0, 4}, {0, 0, 0}, 20), settings);
    asperity::Run run(1);
    render(renderer, run);
    EXPECT_EQ(renderer.rays().primary, 32u * 32u);
    EXPECT_EQ(renderer.rays().shadow, 32u * 32u) << "all see the lamp";
    EXPECT_EQ(renderer.rays().bounce, 0u);
}

// A pass that is begun with some pixels is the pass it would have been: picture and rays, to the
// bit, even where a begun pass is begun again or stopped.
TEST(Renderer, PassesMayBeBegunWithSomePixels) {
    const ModelScene scene = rich_scene();
    Renderer whole(scene, kFront, small()), begun(scene, kFront, small());
    asperity::Run run(2);
    const auto every = [](std::size_t n, std::size_t first) {
        std::vector<std::uint8_t> chosen(40 * 24, 0);
        for (std::size_t k = first; k < chosen.size(); k += n) chosen[k] = 1;
        return chosen;
    };
    for (int pass = 0; pass < 2; ++pass) {
        ASSERT_TRUE(whole.render_pass(run));
        ASSERT_TRUE(begun.begin_pass(run, every(7, 3)));
        ASSERT_TRUE(begun.begin_pass(run, every(3, 0)));
        EXPECT_EQ(begun.samples(), static_cast<std::uint32_t>(pass)) << "of those that have fewest";
        std::size_t ahead = 0;
        for (const Pixel& pixel : begun.film().pixels())
            ahead += pixel.samples == static_cast<std::uint32_t>(pass) + 1;
        EXPECT_EQ(ahead, 137u + 320u - 46u) << "those of either, once";
        ASSERT_TRUE(begun.render_pass(run));
    }
    EXPECT_EQ(begun.film().image().rgb, whole.film().image().rgb);
    EXPECT_EQ(begun.rays().primary, whole.rays().primary);
    EXPECT_EQ(begun.rays().shadow, whole.rays().shadow);
    EXPECT_EQ(begun.rays().bounce, whole.rays().bounce);

    asperity::Run stopped(1);
    stopped.request_stop();
    EXPECT_FALSE(begun.begin_pass(stopped, every(2, 0)));
    EXPECT_THROW(begun.begin_pass(run, std::vector<std::uint8_t>(5, 1)), Error);
}

TEST(Renderer, RefinesUntilTheNoiseIsReached) {
    ModelScene scene = sphere_scene(matt(0.8));
    scene.lights.push_back(make_light(ConstantLightSettings{}));
    RenderSettings settings = small();
    settings.spp = 4096;
    settings.until = 0.03;
    Renderer renderer(scene, kFront, settings);
    asperity::Run run(2);
    const RenderOutcome outcome = render(renderer, run);
    EXPECT_LE(outcome.noise, 0.03);
    EXPECT_GT(outcome.noise, 0.01);
    EXPECT_GE(outcome.samples, 16u);
    EXPECT_LT(outcome.samples, 4096u);
    EXPECT_EQ(outcome.samples, renderer.samples());
    EXPECT_FALSE(outcome.stopped);
}

TEST(Renderer, RefusesWhatIsMissing) {
    const ModelScene scene = sphere_scene(matt(0.5));
    const auto complaint = [&](const ModelScene& s, const RenderSettings& settings) {
        try {
            const Renderer renderer(s, kFront, settings);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::Usage);
            return error.where();
        }
        return std::string();
    };
    EXPECT_EQ(complaint(scene, small()), "");
    EXPECT_EQ(complaint(scene, small(0, 10)), "width");
    ModelScene broken = scene;
    broken.model = nullptr;
    EXPECT_EQ(complaint(broken, small()), "model");
    broken = scene;
    broken.lights.push_back(nullptr);
    EXPECT_EQ(complaint(broken, small()), "light");
}

}  // namespace
}  // namespace asperity

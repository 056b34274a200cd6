// SPDX-License-Identifier: Apache-2.0
#include "render_options.h"

#include "file_kind.h"
#include "options.h"

#include <asperity/core/error.h>
#include <asperity/formats/models/model_reader.h>
#include <asperity/params/suggest.h>
#include <asperity/render/builtin_models.h>
#include <asperity/render/camera_controller.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace asperity::cli {

namespace {

/// The options of a picture; after a comma a second spelling. A default that stands in square
/// brackets is only shown: what happens without the option is decided elsewhere.
constexpr OptionInfo kRenderOptions[] = {
    {"model", "NAME|FILE", kModel,
     "sphere, plane, knot, ball, bowl, none (the light alone), or a file (.obj .ply .stl .gltf "
     ".glb .3ds)",
     "ball"},
    {"normals", "NAME", kModel, "given (smooth where the model has none), smooth or facet",
     "given"},
    {"crease", "D", kModel, "smooth normals: facets that meet at more degrees keep an edge", "180"},
    {"no-fit", "", kModel, "leave a file's model where it is, and as large"},
    {"floor", "", kModel, "put a floor below the model"},

    {"brdf", "SPEC|FILE", kMaterial,
     "a result of asperity simulate, or a model as asperity compare takes it; given twice, the "
     "second is assigned right of the split",
     "cook-torrance:roughness=0.4,metallic=1"},
    {"split", "S", kMaterial, "where the second BRDF begins, as a share of the width", "0.5"},
    {"normalize-factor", "X[,Y]", kMaterial,
     "multiplies the BRDF, first and second; 1 is physically right", "1"},
    {"albedo", "R/G/B[,R/G/B]", kMaterial,
     "diffuse colour added to the BRDF, first and second: albedo / pi + BRDF", "0"},
    {"stage", "SPEC", kMaterial, "what the floor and the ball's dish are made of",
     "lambert:albedo=0.5"},

    {"light", "NAME", kLight,
     "point, directional, constant, sky or env:FILE (a latitude-longitude .exr or .hdr); may be "
     "given more than once",
     "sky"},
    {"light-position", "X,Y,Z", kLight, "point: where it is; x right, y up, z to the viewer",
     "1,1,1"},
    {"light-direction", "X,Y,Z", kLight, "directional: where it comes from", "1,1,1"},
    {"light-intensity", "I", kLight,
     "point: radiant intensity; directional: irradiance; constant: radiance", "[300; 3; 1]"},
    {"light-colour,--light-color", "R/G/B", kLight, "multiplies the intensity", "1"},
    {"light-rotation", "D", kLight, "env: turns it about the upright axis, degrees", "0"},
    {"light-scale", "S", kLight, "env, sky: multiplies the light", "1"},
    {"sun-elevation", "D", kLight, "sky: of the sun above the horizon, 0 to 90 degrees", "45"},
    {"sun-azimuth", "D", kLight,
     "sky: of the sun; 0 behind the model, 90 to its right, 180 behind the viewer", "130"},
    {"sun-diameter", "D", kLight, "sky: of the sun; larger ones give softer shadows", "0.533"},
    {"turbidity", "T", kLight, "sky: from 2, very clear, to 10, hazy", "3"},
    {"background", "lights|R/G/B", kLight, "what is seen behind the model", "lights"},

    {"camera", "NAME", kCamera,
     "perspective, or panorama: all directions as a latitude-longitude map that --light env:FILE "
     "takes, twice as wide as high",
     "perspective"},
    {"camera-azimuth", "D", kCamera, "goes round the target: 0 in front, 90 to the right", "0"},
    {"camera-elevation", "D", kCamera, "above the target, -89.9 to 89.9", "0"},
    {"camera-distance", "D", kCamera, "from the target; models have radius 1", "3.5"},
    {"camera-position", "X,Y,Z", kCamera, "in place of the three above", "[0,0,3.5]"},
    {"camera-target", "X,Y,Z", kCamera, "what the camera looks at", "0,0,0"},
    {"camera-fov", "D", kCamera, "angle from the lower to the upper edge of the picture", "40"},

    {"width", "N", kRun, "pixels", "512"},
    {"height", "N", kRun, "pixels", "512"},
    {"spp", "N", kRun, "samples per pixel; with --until the most there may be",
     "[64; 4096 with --until]"},
    {"until", "P", kRun, "go on until the noise of the picture is below P: 2% or 0.02",
     "[--spp decides]"},
    {"depth", "N", kRun, "reflections that light may make; 1: direct light, the thesis' look", "4"},
    {"integrator", "NAME", kRun,
     "path, or stratified: the thesis' Monte Carlo (eq. 3.3), direct light only, for teaching",
     "path"},
    {"strata", "N", kRun, "stratified: N x N cells of the hemisphere", "8"},
    {"direct", "NAME", kRun,
     "how direct light is sampled: mis (both ways, weighted), light or brdf", "mis"},
    {"filter", "NAME", kRun, "where in a pixel its samples lie: tent, box or centre", "tent"},
    {"seed", "K", kRun, "same settings, same seed: same picture", "1"},

    {"tonemap", "NAME", kOutput,
     "PNG: none (cut at white), reinhard, aces, or thesis (reinhard with gamma22)", "none"},
    {"exposure", "STOPS", kOutput, "PNG: light times 2^STOPS", "0"},
    {"transfer", "NAME", kOutput, "PNG: srgb, gamma22 or linear", "srgb"},
};

constexpr Names<Integrator, 2> kIntegrators = {
    {{"path", Integrator::Path}, {"stratified", Integrator::Stratified}}};
constexpr Names<DirectLight, 3> kDirectLights = {{{"mis", DirectLight::Mis},
                                                  {"light", DirectLight::LightOnly},
                                                  {"brdf", DirectLight::BrdfOnly}}};
constexpr Names<PixelFilter, 3> kFilters = {
    {{"tent", PixelFilter::Tent}, {"box", PixelFilter::Box}, {"centre", PixelFilter::Centre}}};
constexpr Names<ToneMapping, 4> kToneMappings = {
    {{"none", ToneMapping{}},
     {"reinhard", ToneMapping{0, ToneCurve::Reinhard, Transfer::Srgb}},
     {"aces", ToneMapping{0, ToneCurve::Aces, Transfer::Srgb}},
     {"thesis", kThesisLook}}};
constexpr Names<Transfer, 3> kTransfers = {
    {{"srgb", Transfer::Srgb}, {"gamma22", Transfer::Gamma22}, {"linear", Transfer::Linear}}};
constexpr Names<NormalStyle, 3> kNormalStyles = {{{"given", NormalStyle::AsGiven},
                                                  {"smooth", NormalStyle::Smooth},
                                                  {"facet", NormalStyle::Facet}}};
/// Whether it sees all round.
constexpr Names<bool, 2> kCameras = {{{"perspective", false}, {"panorama", true}}};

template <typename Value, std::size_t N>
std::vector<std::string> words_of(const Names<Value, N>& names) {
    std::vector<std::string> words;
    for (const auto& [name, value] : names) words.emplace_back(name);
    return words;
}

/// Of --model: nothing but light.
constexpr std::string_view kNoModel = "none";

/// What tells most of a picture's look: part of its provenance even when it was not given.
constexpr const char* kAlwaysTold[] = {"model", "brdf", "light",      "width", "height",
                                       "depth", "seed", "integrator", "direct"};

bool is_shown_only(const std::string& text) {
    return !text.empty() && text.front() == '[';
}

/// The first of the names an option has.
std::string first_name(const char* names) {
    const std::string all = names;
    return all.substr(0, all.find(','));
}

Rgb read_colour(const OptionValue& value, std::string_view text, const Range& range) {
    const std::vector<double> numbers = value.numbers(text, '/', range);
    if (numbers.size() == 1) return {numbers[0], numbers[0], numbers[0]};
    if (numbers.size() != 3) value.refuse(in_quotes(text) + " is neither one number nor three");
    return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

std::vector<std::string> render_names(const std::string& option) {
    if (option == "integrator") return words_of(kIntegrators);
    if (option == "direct") return words_of(kDirectLights);
    if (option == "filter") return words_of(kFilters);
    if (option == "tonemap") return words_of(kToneMappings);
    if (option == "transfer") return words_of(kTransfers);
    if (option == "normals") return words_of(kNormalStyles);
    if (option == "camera") return words_of(kCameras);
    if (option == "light") return {"point", "directional", "constant", "sky", "env:"};
    if (option != "model") return {};
    std::vector<std::string> models = {std::string(kNoModel)};
    for (const BuiltinModel& model : builtin_models()) models.push_back(model.name);
    return models;
}

void RenderOptions::add_to(CLI::App& app, std::initializer_list<const char*> only) {
    for (const OptionInfo& info : kRenderOptions) {
        const std::string name = first_name(info.name);
        if (only.size() > 0 && std::find(only.begin(), only.end(), name) == only.end()) continue;
        names_.push_back(name);
        texts_[name] = {};
        std::string otherwise = info.otherwise;
        if (is_shown_only(otherwise))
            otherwise = otherwise.substr(1, otherwise.size() - 2);
        else if (!otherwise.empty())
            texts_[name] = {otherwise};
        options_[name] = add_option(app, info, otherwise);
    }
    for (const char* repeated : {"brdf", "light"}) {
        const auto option = options_.find(repeated);
        if (option != options_.end())
            option->second->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    }
}

void RenderOptions::read() {
    for (const std::string& name : names_) {
        if (given(name)) texts_[name] = options_.at(name)->results();
    }
}

bool RenderOptions::given(const std::string& name) const {
    return options_.at(name)->count() > 0;
}

const std::vector<std::string>& RenderOptions::texts(const std::string& name) const {
    return texts_.at(name);
}

OptionValue RenderOptions::value(const std::string& name) const {
    const auto entry = texts_.find(name);
    const OptionValue value(entry->first, entry->second.back());
    if (value.text().empty()) value.refuse("the value is empty");
    return value;
}

Rgb RenderOptions::colour(const std::string& name, const Range& range) const {
    const OptionValue found = value(name);
    return read_colour(found, found.text(), range);
}

std::array<Rgb, 2> RenderOptions::two_colours(const std::string& name, const Range& range,
                                              Rgb otherwise) const {
    const OptionValue found = value(name);
    const auto parts = split(found.text(), ',');
    if (parts.size() > 2) found.refuse(in_quotes(found.text()) + " is more than two colours");
    return {read_colour(found, parts[0], range),
            parts.size() > 1 ? read_colour(found, parts[1], range) : otherwise};
}

std::array<double, 2> RenderOptions::two_numbers(const std::string& name, const Range& range,
                                                 double otherwise) const {
    const OptionValue found = value(name);
    const std::vector<double> numbers = found.numbers(found.text(), ',', range);
    if (numbers.size() > 2) found.refuse(in_quotes(found.text()) + " is more than two numbers");
    return {numbers[0], numbers.size() > 1 ? numbers[1] : otherwise};
}

Vec3 RenderOptions::vector(const std::string& name) const {
    const OptionValue found = value(name);
    const std::vector<double> numbers = found.numbers(found.text(), ',', kAnyNumber);
    if (numbers.size() != 3) found.refuse(in_quotes(found.text()) + " is not X,Y,Z");
    return {numbers[0], numbers[1], numbers[2]};
}

io::Provenance RenderOptions::provenance() const {
    io::Provenance provenance;
    for (const std::string& name : names_) {
        const bool told = given(name) || std::find(std::begin(kAlwaysTold), std::end(kAlwaysTold),
                                                   name) != std::end(kAlwaysTold);
        if (!told) continue;
        for (const std::string& text : texts(name)) provenance.emplace_back(name, text);
    }
    return provenance;
}

RenderSettings render_settings(const RenderOptions& options) {
    constexpr int kMostSide = 16384, kMostSamples = 1 << 24, kMostUntil = 4096;
    constexpr Range kNoise = {1e-6, 1, false, true};
    RenderSettings s;
    s.width = options.value("width").integer(1, kMostSide);
    s.height = options.value("height").integer(1, kMostSide);
    if (options.given("until")) {
        s.until = options.value("until").share(kNoise);
        s.spp = kMostUntil;
    }
    if (options.given("spp"))
        s.spp = static_cast<std::uint32_t>(options.value("spp").natural({1, kMostSamples}));
    s.depth = options.value("depth").integer(1, 1000);
    s.integrator = options.value("integrator").choice(kIntegrators);
    s.direct = options.value("direct").choice(kDirectLights);
    s.filter = options.value("filter").choice(kFilters);
    s.strata = options.value("strata").integer(1, 1024);
    if (options.given("strata") && s.integrator != Integrator::Stratified)
        options.value("strata").refuse("goes with --integrator stratified");
    s.seed = options.value("seed").natural();
    s.show_lights = options.value("background").text() == "lights";
    if (!s.show_lights) s.background = options.colour("background", kNotNegative);
    check(s);
    return s;
}

ToneMapping tone_mapping(const RenderOptions& options) {
    constexpr Range kStops = {-100, 100};
    ToneMapping mapping = options.value("tonemap").choice(kToneMappings);
    mapping.exposure = options.value("exposure").number(kStops);
    if (options.given("transfer")) {
        mapping.transfer = options.value("transfer").choice(kTransfers);
    }
    return mapping;
}

namespace {

/// What is seen all round from one place, by default the middle of the world.
Camera panorama(const RenderOptions& options) {
    for (const char* name :
         {"camera-azimuth", "camera-elevation", "camera-distance", "camera-target", "camera-fov"})
        if (options.given(name))
            throw Error(ErrorCode::Usage,
                        "a panorama sees all directions: it has a --camera-position alone", name);
    const RenderSettings size = render_settings(options);
    if (size.width != 2 * size.height)
        throw Error(ErrorCode::Usage,
                    fmt::format("a panorama is twice as wide as high: --width {} --height {}",
                                size.width, (size.width + 1) / 2),
                    "camera");
    Camera camera;
    camera.panorama = true;
    camera.position =
        options.given("camera-position") ? options.vector("camera-position") : Vec3{0, 0, 0};
    return camera;
}

}  // namespace

Camera camera(const RenderOptions& options) {
    if (options.value("camera").choice(kCameras)) return panorama(options);
    constexpr Range kFov = {1, 170};
    constexpr Range kElevation = {-89.9, 89.9};
    constexpr Range kDistance = {0.01, 1000};
    const Vec3 target = options.vector("camera-target");
    const double fov = options.value("camera-fov").number(kFov);
    if (options.given("camera-position")) {
        for (const char* name : {"camera-azimuth", "camera-elevation", "camera-distance"}) {
            if (options.given(name))
                throw Error(ErrorCode::Usage, "does not go with --camera-position", name);
        }
        return look_at(options.vector("camera-position"), target, fov);
    }
    Orbiter orbiter;
    orbiter.target = target;
    orbiter.fov_deg = fov;
    orbiter.azimuth_deg = options.value("camera-azimuth").number(kAnyNumber);
    orbiter.elevation_deg = options.value("camera-elevation").number(kElevation);
    orbiter.distance = options.value("camera-distance").number(kDistance);
    return orbiter.camera();
}

namespace {

/// For a name that is neither built in nor a file of a model.
[[noreturn]] void refuse_model(const OptionValue& value) {
    const std::vector<std::string> names = render_names("model");
    const std::string text(value.text());
    std::string meant = did_you_mean(text, names);
    if (meant.empty()) meant = did_you_mean_file(text);
    value.refuse(fmt::format("'{}' is neither a file of a model nor one of {}{}", text,
                             fmt::join(names, ", "), meant));
}

}  // namespace

LoadedModel load_model(const RenderOptions& options) {
    constexpr Range kCrease = {0, 180};
    const NormalStyle style = options.value("normals").choice(kNormalStyles);
    const double crease = options.value("crease").number(kCrease);
    const std::string name(options.value("model").text());
    LoadedModel loaded;
    if (name == kNoModel) {
        for (const char* given : {"normals", "crease", "no-fit", "brdf", "floor"})
            if (options.given(given)) throw Error(ErrorCode::Usage, "there is no model", given);
        loaded.model.name = "none";
        return loaded;
    }
    if (is_builtin_model(name)) {
        if (options.given("no-fit"))
            throw Error(ErrorCode::Usage, "is for models from files", "no-fit");
        loaded.model = make_builtin_model(name);
        if (options.given("normals") || options.given("crease")) {
            for (TriangleMesh& mesh : loaded.model.meshes) set_normals(mesh, style, crease);
        }
    } else {
        std::error_code ignored;
        if (std::filesystem::exists(name, ignored)) require_kind(name, FileKind::Model);
        if (!io::is_model_file(name)) refuse_model(options.value("model"));
        io::ModelReadSettings settings;
        settings.normals = style;
        settings.crease_deg = crease;
        settings.fit = !options.given("no-fit");
        io::ModelFile file = io::read_model(name, settings);
        loaded = {std::move(file.model), file.dropped_triangles, std::move(file.remarks)};
    }
    if (options.given("floor")) add_floor(loaded.model);
    return loaded;
}

}  // namespace asperity::cli

// SPDX-License-Identifier: Apache-2.0
#include "arrays.h"
#include "core.h"
#include "own_bsdf.h"
#include "task.h"

#include <asperity/core/error.h>
#include <asperity/formats/images/image_reader.h>
#include <asperity/formats/models/model_reader.h>
#include <asperity/measured/baked_brdf.h>
#include <asperity/render/builtin_models.h>
#include <asperity/render/camera_controller.h>
#include <asperity/render/environment_map.h>
#include <asperity/render/renderer.h>
#include <asperity/render/sky.h>
#include <asperity/render/tonemap.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <optional>

namespace asperity::python {
namespace {

using Triple = std::array<double, 3>;

Vec3 vector(const Triple& t) {
    return {t[0], t[1], t[2]};
}
Rgb colour(const Triple& t) {
    return {t[0], t[1], t[2]};
}

/// A light as a list that grows: a sky is two.
struct LightList {
    std::vector<std::shared_ptr<const Light>> lights;
};

LightList one(std::unique_ptr<Light> light) {
    LightList list;
    list.lights.push_back(std::move(light));
    return list;
}

LightList sky(double elevation, double azimuth, double diameter, double turbidity, double scale) {
    SkySettings s;
    s.sun_elevation_deg = elevation;
    s.sun_azimuth_deg = azimuth;
    s.sun_diameter_deg = diameter;
    s.turbidity = turbidity;
    s.scale = scale;
    LightList list;
    for (auto& light : make_sky(s)) list.lights.push_back(std::move(light));
    return list;
}

LightList environment(const std::string& path, double rotation, double scale) {
    EnvironmentMapSettings s;
    s.rotation_deg = rotation;
    s.scale = scale;
    s.name = path;
    return one(make_environment_light(io::read_image(path), s));
}

struct SceneModel {
    std::shared_ptr<const TracedModel> traced;
    std::vector<std::string> remarks;
};

SceneModel open_model(const std::string& name, bool floor, bool fit, int threads) {
    const nb::gil_scoped_release free;
    SceneModel scene;
    Model model;
    if (is_builtin_model(name)) {
        model = make_builtin_model(name);
    } else {
        if (!io::is_model_file(name)) make_builtin_model(name);  // says which names there are
        io::ModelReadSettings settings;
        settings.fit = fit;
        io::ModelFile file = io::read_model(name, settings);
        model = std::move(file.model);
        scene.remarks = std::move(file.remarks);
    }
    if (floor) add_floor(model);
    Run run(threads);
    scene.traced = std::make_shared<TracedModel>(model, run);
    return scene;
}

/// A BSDF as it is rendered: analytic ones as they are, others baked.
BsdfHandle ready(const BsdfHandle& b, int threads) {
    if (b.analytic) return b;
    const nb::gil_scoped_release free;
    Run run(threads);
    return {bake_brdf(*b.bsdf, run), true};
}
BsdfHandle ready(const MeasurementHandle& m, int threads) {
    const nb::gil_scoped_release free;
    Run run(threads);
    return {bake_brdf(*m.measurement, run), true};
}
BsdfHandle ready_own(OwnBsdf& own, int threads) {
    return {with_answers(own,
                         [&](const Bsdf& bsdf) {
                             Run run(threads);
                             // An own BSDF without a symmetry is asked for fewer pairs
                             BakeSettings settings;
                             if (!bsdf.isotropic()) settings = {16, 16, 48};
                             return bake_brdf(bsdf, run, settings);
                         }),
            true};
}

Camera camera_of(const std::optional<Triple>& position, const Triple& target, double azimuth,
                 double elevation, double distance, double fov) {
    if (position) return look_at(vector(*position), vector(target), fov);
    Orbiter orbiter;
    orbiter.target = vector(target);
    orbiter.azimuth_deg = azimuth;
    orbiter.elevation_deg = elevation;
    orbiter.distance = distance;
    orbiter.fov_deg = fov;
    return orbiter.camera();
}

/// What render gives beside the picture.
nb::dict to_dict(const RenderOutcome& outcome) {
    nb::dict d;
    d["samples"] = outcome.samples;
    d["noise"] = outcome.noise;
    d["stopped"] = outcome.stopped;
    d["seconds"] = outcome.seconds;
    return d;
}

nb::tuple render_scene(const SceneModel& model, const std::vector<BsdfHandle>& brdfs, double split,
                       const BsdfHandle& stage, const std::vector<LightList>& lights,
                       const Camera& camera, const RenderSettings& settings, int threads,
                       const Callbacks& callbacks) {
    ModelScene scene{
        model.traced, Material(brdfs.at(0).bsdf), std::nullopt, Material(stage.bsdf), {}};
    if (brdfs.size() > 1) scene.split = SplitView{Material(brdfs[1].bsdf), split};
    for (const LightList& list : lights)
        scene.lights.insert(scene.lights.end(), list.lights.begin(), list.lights.end());
    check(settings);
    Renderer renderer(scene, camera, settings);
    Run run(threads);
    const auto outcome = run_task(run, callbacks, [&] { return render(renderer, run); });
    if (renderer.rays().primary == 0) {
        if (!outcome.interrupted)
            throw Error(ErrorCode::Stopped, "stopped before anything was to be seen");
        PyErr_SetNone(PyExc_KeyboardInterrupt);
        throw nb::python_error();
    }
    const std::size_t height = static_cast<std::size_t>(settings.height);
    const std::size_t width = static_cast<std::size_t>(settings.width);
    return nb::make_tuple(to_array(renderer.film().image().rgb, {height, width, 3}),
                          to_dict(outcome.value), outcome.interrupted);
}

using Pixels = nb::ndarray<const float, nb::shape<-1, -1, 3>, nb::c_contig, nb::device::cpu>;

nb::ndarray<nb::numpy, std::uint8_t> tonemapped(const Pixels& pixels, const std::string& curve,
                                                double exposure) {
    ToneMapping mapping;
    if (curve == "reinhard")
        mapping.curve = ToneCurve::Reinhard;
    else if (curve == "aces")
        mapping.curve = ToneCurve::Aces;
    else if (curve == "thesis")
        mapping = kThesisLook;
    else if (curve != "none")
        throw Error(ErrorCode::Usage, "'" + curve + "' is none of none, reinhard, aces, thesis",
                    "curve");
    mapping.exposure = exposure;
    Image image;
    image.height = static_cast<int>(pixels.shape(0));
    image.width = static_cast<int>(pixels.shape(1));
    image.rgb.assign(pixels.data(), pixels.data() + pixels.size());
    return to_array(to_bytes(mapping, image), {pixels.shape(0), pixels.shape(1), 3});
}

template <typename Enum>
void set_choice(Enum& field, const std::string& word, const char* where,
                std::initializer_list<std::pair<const char*, Enum>> words) {
    std::string names;
    for (const auto& [name, value] : words) {
        if (word == name) {
            field = value;
            return;
        }
        names += (names.empty() ? "" : ", ") + std::string(name);
    }
    throw Error(ErrorCode::Usage, "'" + word + "' is none of " + names, where);
}

void add_render_settings(nb::module_& module) {
    using S = RenderSettings;
    nb::class_<S>(module, "RenderSettings")
        .def(nb::init<>())
        .def_rw("width", &S::width)
        .def_rw("height", &S::height)
        .def_rw("spp", &S::spp)
        .def_rw("until", &S::until)
        .def_rw("depth", &S::depth)
        .def_rw("strata", &S::strata)
        .def_rw("seed", &S::seed)
        .def("set_integrator",
             [](S& s, const std::string& word) {
                 set_choice<Integrator>(
                     s.integrator, word, "integrator",
                     {{"path", Integrator::Path}, {"stratified", Integrator::Stratified}});
             })
        .def("set_direct",
             [](S& s, const std::string& word) {
                 set_choice<DirectLight>(s.direct, word, "direct",
                                         {{"mis", DirectLight::Mis},
                                          {"light", DirectLight::LightOnly},
                                          {"brdf", DirectLight::BrdfOnly}});
             })
        .def("set_filter",
             [](S& s, const std::string& word) {
                 set_choice<PixelFilter>(s.filter, word, "filter",
                                         {{"tent", PixelFilter::Tent},
                                          {"box", PixelFilter::Box},
                                          {"centre", PixelFilter::Centre}});
             })
        .def("set_background", [](S& s, const Triple& radiance) {
            s.show_lights = false;
            s.background = colour(radiance);
        });
}

}  // namespace

void add_renders(nb::module_& module) {
    nb::class_<SceneModel>(module, "SceneModel").def_ro("remarks", &SceneModel::remarks);
    nb::class_<LightList>(module, "LightList");
    nb::class_<Camera>(module, "Camera");
    add_render_settings(module);
    module.def("point_light", [](const Triple& position, double intensity, const Triple& rgb) {
        return one(make_light(PointLightSettings{vector(position), intensity, colour(rgb)}));
    });
    module.def("directional_light", [](const Triple& from, double irradiance, const Triple& rgb) {
        return one(make_light(DirectionalLightSettings{vector(from), irradiance, colour(rgb)}));
    });
    module.def("constant_light", [](const Triple& radiance) {
        return one(make_light(ConstantLightSettings{colour(radiance)}));
    });
    module.def("sky_light", sky);
    module.def("environment_light", environment);
    module.def("open_model", open_model);
    module.def("camera", camera_of, nb::arg("position").none(), nb::arg("target"),
               nb::arg("azimuth"), nb::arg("elevation"), nb::arg("distance"), nb::arg("fov"));
    module.def("ready", [](const BsdfHandle& b, int threads) { return ready(b, threads); });
    module.def("ready", [](const MeasurementHandle& m, int threads) { return ready(m, threads); });
    module.def("ready", ready_own);
    module.def("render", render_scene);
    module.def("tonemap", tonemapped, nb::arg("pixels"), nb::arg("curve"), nb::arg("exposure"));
}

}  // namespace asperity::python

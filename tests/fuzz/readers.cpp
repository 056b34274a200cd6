// SPDX-License-Identifier: Apache-2.0
#include "readers.h"

#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>
#include <asperity/formats/bsdfs/bsdf_format.h>
#include <asperity/formats/heights/heights_format.h>
#include <asperity/formats/heights/heights_test_files.h>
#include <asperity/formats/heights/surface_files.h>
#include <asperity/formats/images/image_reader.h>
#include <asperity/formats/images/render_writer.h>
#include <asperity/formats/models/model_reader.h>
#include <asperity/formats/models/model_test_files.h>
#include <asperity/formats/models/model_writer.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/formats/test_files.h>
#include <asperity/gonio/experiment_text.h>
#include <asperity/gonio/measure.h>
#include <asperity/render/builtin_models.h>
#include <asperity/surface/surface_text.h>
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace asperity::test {
namespace {

using io::test::get;
using io::test::TemporaryFolder;
using Seeds = std::vector<std::string>;

constexpr std::uint64_t kMostTriangles = 100000;

void require(bool good, const char* what) {
    if (!good) throw std::logic_error(what);
}

/// "Stanford PLY" as a part of a file's name.
std::string plain(std::string_view name) {
    std::string text(name);
    for (char& c : text) {
        const auto u = static_cast<unsigned char>(c);
        c = std::isalnum(u) != 0 ? static_cast<char>(std::tolower(u)) : '-';
    }
    return text;
}

/// What `write` writes.
template <typename Write>
std::string written(const std::string& name, Write write) {
    const TemporaryFolder folder;
    write(folder / name);
    return get(folder / name);
}

// Models

void read_model(const std::string& path) {
    io::ModelReadSettings settings;
    settings.limits.triangles = kMostTriangles;
    const Model model = io::read_model(path, settings).model;
    check(model);
    require(statistics(model).instanced_triangles > 0, "a model without triangles");
    const Bounds box = bounds(model);
    require(std::max({box.high.x, box.high.y, box.high.z}) <= 1.0001 &&
                std::min({box.low.x, box.low.y, box.low.z}) >= -1.0001,
            "a model that was not fitted");
    for (const TriangleMesh& mesh : model.meshes) {
        for (const Vec3f n : mesh.normals)
            require(std::abs(length(to_double(n)) - 1) < 1e-5, "a normal that is no unit vector");
    }
}

Seeds model_seeds() {
    Seeds seeds;
    for (const io::test::TestFile& file : io::test::model_test_files()) seeds.push_back(file.bytes);
    const TriangleMesh sphere = make_sphere(5, 3);
    seeds.push_back(written("a.obj", [&](const std::string& p) { io::write_obj(sphere, p); }));
    seeds.push_back(written("a.ply", [&](const std::string& p) { io::write_ply(sphere, p); }));
    return seeds;
}

// The words of all formats of models.
const Seeds kModelWords = {"v ",
                           "vn ",
                           "vt ",
                           "f ",
                           "o ",
                           "//",
                           "mtllib ",
                           "\\\n",
                           "ply\n",
                           "format ascii 1.0\n",
                           "format binary_little_endian 1.0\n",
                           "format binary_big_endian 1.0\n",
                           "element vertex ",
                           "element face ",
                           "property list uchar int vertex_indices\n",
                           "property float x\n",
                           "end_header\n",
                           "solid ",
                           "facet normal ",
                           "outer loop\n",
                           "vertex ",
                           "endloop\n",
                           "endfacet\n",
                           "endsolid\n",
                           "\"POSITION\":",
                           "\"NORMAL\":",
                           "\"indices\":",
                           "\"byteStride\":",
                           "\"byteOffset\":",
                           "\"count\":",
                           "\"children\":[",
                           "\"matrix\":[",
                           "\"rotation\":[",
                           "\"mode\":5",
                           "data:;base64,",
                           "4294967295",
                           "-1",
                           "nan",
                           "1e308"};

// Pictures

void read_picture(const std::string& path) {
    const Image image = io::read_image(path);
    require(image.width > 0 && image.height > 0 &&
                image.rgb.size() == 3 * static_cast<std::size_t>(image.width) *
                                        static_cast<std::size_t>(image.height),
            "a picture of another size than it says");
}

Seeds picture_seeds() {
    Film film(9, 5);
    for (int x = 0; x < 9; ++x) film.at(x, 2).mean = {0.25 * x, 0.5, 1.0};
    const std::string line = {2, 2, 0, 9, '\x89', 1, 5, 1, 2, 3, 4, 5,      '\x84',
                              7, 9, 9, 8, 7,      6, 5, 4, 3, 2, 1, '\x89', '\x80'};
    return {written("a.exr", [&](const std::string& p) { io::write_render_exr(film, {}, p); }),
            "#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 9\n" + line + line,
            std::string("#?RGBE\n\n+X 2 -Y 4\n") + "\x09\x08\x07\x80\x01\x01\x01\x03" +
                "\x09\x08\x07\x80\x01\x01\x01\x03"};
}

const Seeds kPictureWords = {"dataWindow", "displayWindow", "box2i",
                             "channels",   "chlist",        "compression",
                             "tiles",      "tiledesc",      "lineOrder",
                             "preview",    "#?RADIANCE\n",  "FORMAT=32-bit_rle_rgbe\n",
                             "EXPOSURE=",  "-Y 1 +X 1\n"};

// Heights

void read_surface(const std::string& path, const std::string& format) {
    Run run(1);
    Preparation how;
    how.fill = Fill::Smooth;
    const Heightfield surface =
        prepare(io::read_topography(path, {format, {}, {}}, run), how, path, run);
    require(surface.nx > 1 && surface.ny > 1 &&
                surface.heights.size() ==
                    static_cast<std::size_t>(surface.nx) * static_cast<std::size_t>(surface.ny),
            "a surface of another size than it says");
    require(std::all_of(surface.heights.begin(), surface.heights.end(),
                        [](float h) { return std::isfinite(h); }),
            "a height that is not finite");
}

Heightfield small_surface() {
    Heightfield surface;
    surface.nx = 7;
    surface.ny = 5;
    for (int k = 0; k < 35; ++k) surface.heights.push_back(static_cast<float>(k * k % 11) / 8);
    return surface;
}

const Seeds kHeightsWords = {"Gwyddion Simple Field 1.0\n",
                             "XRes = ",
                             "YRes = ",
                             "XReal = ",
                             "ZUnits = m\n",
                             "IHDR",
                             "IDAT",
                             "IEND",
                             "# ",
                             ",",
                             "\t",
                             "nan"};

// Results and BSDFs

Measurement small_measurement() {
    Experiment experiment;
    experiment.illumination.theta_deg = {0, 50};
    experiment.detector.resolution = 8;
    experiment.run.rays = 2000;
    experiment.run.bounces = 3;
    Run run(1);
    return measure(small_surface(), experiment, run);
}

void use(const Bsdf& bsdf) {
    std::vector<double> f(static_cast<std::size_t>(bsdf.channels()));
    for (const Vec3 wi : {Vec3{0, 0, 1}, Vec3{0.6, 0, 0.8}, Vec3{0, -0.96, 0.28}}) {
        bsdf.eval(wi, {-0.6, 0, 0.8}, f);
        require(
            std::all_of(f.begin(), f.end(), [](double x) { return std::isfinite(x) && x >= 0; }),
            "a value of a BSDF that is negative or not finite");
        bsdf.sample(wi, 0.3, 0.6);
    }
}

const Seeds kTextWords = {
    "size", "=",        ":",   ",",      "seed",         "theta",        "alpha",     "roughness",
    "file", "gaussian", "ggx", "thesis", "lambert",      "cooktorrance", "conductor", "ior",
    "k",    "1e308",    "-1",  "nan",    "\xef\xbb\xbf", "[render]\n"};

void add_texts(std::vector<Reader>& all) {
    const auto text = [](const std::string& path) { return get(path); };
    all.push_back({"experiment",
                   "a.txt",
                   {to_text(Experiment{}), to_text(small_measurement().experiment)},
                   kTextWords,
                   [=](const std::string& path) { experiment_from_text(text(path), path); }});
    all.push_back({"surface-spec",
                   "a.txt",
                   {"gaussian:size=64,alpha=0.3", "vgroove:tilt=30", "thesis:roughness=0.5"},
                   kTextWords,
                   [=](const std::string& path) {
                       SurfaceSettings surface;
                       apply_surface_spec(surface, text(path));
                   }});
    all.push_back({"brdf-spec",
                   "a.txt",
                   {"lambert:albedo=0.5", "ggx:alpha=0.3,ior=1.5", "beckmann:alpha=0.2"},
                   kTextWords,
                   [=](const std::string& path) { use(*parse_brdf_spec(text(path))); }});
}

/// A reader, a registry's row: those of `seeds` that it finds its own, or all of them.
template <typename Sniff>
Seeds own_seeds(const Seeds& seeds, Sniff sniff) {
    Seeds own;
    std::copy_if(seeds.begin(), seeds.end(), std::back_inserter(own), sniff);
    return own.empty() ? seeds : own;
}

template <typename Formats>
void add_rows(std::vector<Reader>& all, const std::string& kind, const Formats& formats,
              const Seeds& seeds, const Seeds& words, void (*read)(const std::string&)) {
    for (const auto& format : formats) {
        const Seeds own = own_seeds(seeds, [&](const std::string& bytes) {
            return format.sniff({bytes.substr(0, 4096), bytes.size()});
        });
        all.push_back(
            {kind + "-" + plain(format.name), "a" + format.endings.at(0), own, words, read});
    }
}

/// 16 bits of grey, which we read and do not write.
void write_grey_png(const std::string& path) {
    std::vector<std::uint16_t> heights;
    for (const float h : small_surface().heights)
        heights.push_back(static_cast<std::uint16_t>(8000 * h));
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = 7;
    image.height = 5;
    image.format = PNG_FORMAT_LINEAR_Y;
    png_image_write_to_file(&image, path.c_str(), 0, heights.data(), 0, nullptr);
}

/// A row of the registry starts from what its writer writes, or from the files made for it.
Seeds height_seeds(const io::HeightsFormat& format, const std::string& name) {
    Seeds seeds;
    if (format.write)
        seeds.push_back(
            written(name, [&](const std::string& path) { format.write(small_surface(), path); }));
    if (format.name == "png") seeds.push_back(written(name, write_grey_png));
    for (const io::test::HeightsTestFile& file : io::test::heights_test_files())
        if (file.format == format.name) seeds.push_back(file.bytes);
    return seeds.empty() ? Seeds{std::string()} : seeds;
}

void add_heights(std::vector<Reader>& all) {
    const io::HeightsFormats formats;
    for (const io::HeightsFormat& format : formats.rows()) {
        if (!format.open) continue;
        const std::string name = format.endings.empty() ? "a.txt" : "a." + format.endings.front();
        all.push_back(
            {"heights-" + plain(format.name), name, height_seeds(format, name), kHeightsWords,
             [name = format.name](const std::string& path) { read_surface(path, name); }});
    }
}

void add_bsdfs(std::vector<Reader>& all) {
    const auto measurement = std::make_shared<const Measurement>(small_measurement());
    const io::ExportSource source(measurement, 1);
    // The largest files hold what is quickly computed
    const io::ExportSource quick(std::shared_ptr<const Bsdf>(parse_brdf_spec("lambert:albedo=0.5")),
                                 measurement->experiment, 1);
    const io::BsdfFormats formats;
    for (const io::BsdfFormat& format : formats.rows()) {
        if (!format.read) continue;
        const std::string name = "a." + format.endings.at(0);
        Seeds seeds;
        if (format.write)
            seeds.push_back(written(name, [&](const std::string& path) {
                const bool large = format.name == "merl" || format.name == "rgl";
                format.write(large ? quick : source, io::FormatOptions(format.options, {}), path);
            }));
        else
            seeds.push_back({});
        all.push_back(
            {"bsdfs-" + plain(format.name), name, seeds, {}, [format](const std::string& path) {
                 use(*format.read(path));
             }});
    }
}

std::vector<Reader> make_readers() {
    std::vector<Reader> all;
    add_rows(all, "models", io::model_formats(), model_seeds(), kModelWords, read_model);
    add_rows(all, "images", io::image_formats(), picture_seeds(), kPictureWords, read_picture);
    add_heights(all);
    add_bsdfs(all);
    all.push_back({"result",
                   "a.asp",
                   {written("a.asp",
                            [](const std::string& path) {
                                io::save_measurement(small_measurement(), path);
                            })},
                   {"tensor_file"},
                   [](const std::string& path) { io::checksum(io::load_measurement(path)); }});
    add_texts(all);
    return all;
}

}  // namespace

const std::vector<Reader>& readers() {
    static const std::vector<Reader> kReaders = make_readers();
    return kReaders;
}

std::string fault_of(const Reader& reader, const std::string& path) {
    try {
        reader.read(path);
    } catch (const Error& error) {
        const std::string text = error.what();
        // A .gltf may name a file that is not there.
        const bool missing = error.code() == ErrorCode::InputOutput && path.ends_with(".gltf");
        if (error.code() != ErrorCode::InvalidInput && error.code() != ErrorCode::Usage && !missing)
            return fmt::format("an error of code {}: {}", static_cast<int>(error.code()), text);
        // A specification is its own place.
        if (error.where().empty() && !get(path).empty()) return "an error without a place: " + text;
        if (std::any_of(text.begin(), text.end(),
                        [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }))
            return "control characters in an error: " + text;
    } catch (const std::exception& exception) {
        return std::string("an exception: ") + exception.what();
    }
    return {};
}

}  // namespace asperity::test

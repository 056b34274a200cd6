// SPDX-License-Identifier: Apache-2.0
// GGX models as OpenPBR surfaces of MaterialX; the widths as other programs name them in a comment.
#include <asperity/bsdf/spec.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/parse_number.h>
#include <asperity/formats/atomic_file.h>
#include <asperity/formats/bsdfs/bsdf_format.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace asperity::io {
namespace {

using Rgb = std::array<double, 3>;

/// The keys of "ggx:alpha=0.3,...". Throws Error(Usage, "format") for any other Bsdf.
std::map<std::string, std::string> ggx_keys(const ExportSource& source) {
    const std::string spec = source.measurement() ? "" : source.bsdf().name();
    if (!spec.starts_with("ggx:"))
        throw Error(ErrorCode::Usage,
                    "materialx holds the parameters of ggx, no table and no other model: asperity "
                    "fit finds them",
                    "format");
    std::map<std::string, std::string> keys;
    for (const std::string_view piece : split(std::string_view(spec).substr(4), ',')) {
        const std::size_t equals = piece.find('=');
        keys.emplace(piece.substr(0, equals), piece.substr(equals + 1));
    }
    if (keys.contains("lambert"))
        throw Error(ErrorCode::Usage,
                    "materialx takes ggx without lambert: OpenPBR has the diffuse part of a "
                    "dielectric under its facets, dimmed by them, and none of a metal",
                    "format");
    return keys;
}

/// Reflectance of the facets for light that meets them at `theta`: f beside that of perfect
/// mirrors.
Rgb reflectance(const ExportSource& source, const std::string& mirrors, double theta) {
    const Vec3 wi = from_spherical(theta, 0), wo = {-wi.x, -wi.y, wi.z};
    double mirror = 0;
    parse_brdf_spec(mirrors)->eval(wi, wo, {&mirror, 1});
    std::array<double, kMaxBsdfChannels> f{};
    source.bsdf().eval(wi, wo, std::span(f).first(static_cast<std::size_t>(source.channels())));
    const std::array<int, 3> channels = source.rgb_channels();
    Rgb rgb{};
    for (std::size_t c = 0; c < 3; ++c) rgb[c] = f[static_cast<std::size_t>(channels[c])] / mirror;
    return rgb;
}

std::string input(const char* name, double value) {
    return fmt::format("    <input name=\"{}\" type=\"float\" value=\"{:.6g}\" />\n", name, value);
}

std::string input(const char* name, const Rgb& value) {
    return fmt::format(
        "    <input name=\"{}\" type=\"color3\" value=\"{:.6g}, {:.6g}, {:.6g}\" />\n", name,
        value[0], value[1], value[2]);
}

/// Metals of OpenPBR: base_color is F along the normal, specular_color scales Schlick's F at
/// arccos(1/7), where it differs most from that of metals.
std::string metal_inputs(const ExportSource& source, const std::string& mirrors) {
    constexpr double kCosine = 1.0 / 7;
    const Rgb f0 = reflectance(source, mirrors, 0);
    const Rgb f82 = reflectance(source, mirrors, std::acos(kCosine));
    Rgb tint{};
    for (std::size_t c = 0; c < 3; ++c)
        tint[c] = std::clamp(f82[c] / (f0[c] + (1 - f0[c]) * std::pow(1 - kCosine, 5)), 0.0, 1.0);
    return input("base_metalness", 1) + input("base_color", f0) + input("specular_color", tint);
}

std::string comment_text(const ExportSource& source, double alpha_x, double alpha_y) {
    std::string text;
    for (const std::string& line : source.provenance()) text += "    " + line + "\n";
    text += fmt::format(
        "    alpha = {:.6g}{} is the width of GGX: Mitsuba's alpha, pbrt's roughness "
        "with remaproughness false\n",
        alpha_x, alpha_x == alpha_y ? "" : fmt::format(", {:.6g} along y", alpha_y));
    text += fmt::format(
        "    roughness = sqrt(alpha) = {:.6g}{}: OpenPBR, Disney, glTF's "
        "roughnessFactor, Blender's Principled BSDF\n",
        std::sqrt(alpha_x),
        alpha_x == alpha_y ? "" : fmt::format(", {:.6g} along y", std::sqrt(alpha_y)));
    for (std::size_t at; (at = text.find("--")) != text.npos;) text.replace(at, 2, "- -");
    return "  <!--\n" + text + "  -->\n";
}

BsdfFormat::Remarks write(const ExportSource& source, const FormatOptions&,
                          const std::string& path) {
    const std::map<std::string, std::string> keys = ggx_keys(source);
    const auto number = [&](const char* key, double otherwise) {
        const auto found = keys.find(key);
        return found == keys.end() ? otherwise : parse_double(found->second).value_or(otherwise);
    };
    const auto has = [&](const char* key, const char* value) {
        const auto found = keys.find(key);
        return found != keys.end() && found->second == value;
    };
    const double alpha_x = number("alpha", 0), alpha_y = number("alpha_y", alpha_x);
    std::string mirrors = fmt::format("ggx:alpha={},alpha_y={}", alpha_x, alpha_y);
    if (has("masking", "separable")) mirrors += ",masking=separable";
    BsdfFormat::Remarks remarks = {"renderers may add light that facets reflect more than once"};

    // OpenPBR: alpha along the tangent is r^2 sqrt(2 / (1 + (1 - a)^2)), across it 1 - a of that.
    const double wide = std::max(alpha_x, alpha_y), ratio = std::min(alpha_x, alpha_y) / wide;
    const double roughness = std::sqrt(wide / std::sqrt(2 / (1 + ratio * ratio)));
    if (roughness > 1) remarks.emplace_back("a roughness above 1 is cut to 1");
    if (alpha_y > alpha_x)
        remarks.emplace_back("the rougher direction is the tangent: turn it by 90 degrees");
    std::string inputs;
    if (has("fresnel", "dielectric")) {
        const std::string& ior = keys.at("ior");
        inputs = input("base_weight", 0) + input("base_metalness", 0) +
                 input("specular_ior", parse_double(ior.substr(0, ior.find('/'))).value_or(1.5));
        if (ior.find('/') != ior.npos) remarks.emplace_back("one index for all: that of red");
    } else {
        inputs = metal_inputs(source, mirrors);
    }
    inputs += input("specular_weight", 1) + input("specular_roughness", std::min(1.0, roughness)) +
              input("specular_roughness_anisotropy", 1 - ratio);
    AtomicFile file(path, source.watched());
    file.write("<?xml version=\"1.0\"?>\n<materialx version=\"1.39\">\n" +
               comment_text(source, alpha_x, alpha_y) +
               "  <open_pbr_surface name=\"surface_shader\" type=\"surfaceshader\">\n" + inputs +
               "  </open_pbr_surface>\n  <surfacematerial name=\"surface\" type=\"material\">\n"
               "    <input name=\"surfaceshader\" type=\"surfaceshader\" "
               "nodename=\"surface_shader\" />\n  </surfacematerial>\n</materialx>\n");
    file.commit();
    return remarks;
}

}  // namespace

BsdfFormat materialx_format() {
    return {"materialx",
            {"mtlx"},
            "MaterialX: OpenPBR surface of a ggx model; alpha and roughness in a comment",
            {},
            write,
            {},
            {}};
}

}  // namespace asperity::io

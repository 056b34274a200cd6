// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/models/cook_torrance.h>
#include <asperity/bsdf/models/lambert.h>
#include <asperity/bsdf/models/microfacet.h>
#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

namespace asperity {
namespace {

/// The settings of a specification by their keys. Reading a key ticks it off.
class SpecReader {
  public:
    SpecReader(const std::string& spec, std::string_view settings,
               std::initializer_list<std::string_view> keys)
        : spec_(spec), keys_(keys) {
        while (!settings.empty()) {
            const std::size_t comma = settings.find(',');
            add(settings.substr(0, comma));
            if (comma == std::string_view::npos) break;
            settings.remove_prefix(comma + 1);
            if (settings.empty()) fail("a setting is missing after the last \",\"");
        }
    }

    [[noreturn]] void fail(const std::string& message) const {
        throw Error(ErrorCode::Usage, message, spec_);
    }

    bool has(std::string_view key) const { return find(key) != nullptr; }

    std::string text(std::string_view key, std::string_view otherwise) const {
        const std::string_view* value = find(key);
        return std::string(value ? *value : otherwise);
    }

    double number(std::string_view key) const {
        const std::string_view* value = find(key);
        if (!value) fail(fmt::format("{} is missing", key));
        return to_number(key, *value);
    }

    double number(std::string_view key, double otherwise) const {
        return has(key) ? number(key) : otherwise;
    }

    /// Numbers with "/" between them; empty when the key is absent.
    std::vector<double> list(std::string_view key) const {
        std::vector<double> numbers;
        const std::string_view* value = find(key);
        if (!value) return numbers;
        std::string_view rest = *value;
        for (;;) {
            const std::size_t slash = rest.find('/');
            numbers.push_back(to_number(key, rest.substr(0, slash)));
            if (slash == std::string_view::npos) return numbers;
            rest.remove_prefix(slash + 1);
        }
    }

    /// The value of the word that `key` names, the first one when the key is absent.
    template <class T>
    T choice(std::string_view key,
             std::initializer_list<std::pair<std::string_view, T>> words) const {
        const std::string_view* value = find(key);
        if (!value) return words.begin()->second;
        std::string known;
        for (const auto& [word, meaning] : words) {
            if (*value == word) return meaning;
            known += (known.empty() ? "" : ", ") + std::string(word);
        }
        fail(fmt::format("{}={}: there are {}", key, *value, known));
    }

  private:
    void add(std::string_view setting) {
        const std::size_t equals = setting.find('=');
        const std::string_view key = setting.substr(0, equals);
        if (equals == std::string_view::npos)
            fail(fmt::format("\"{}\" is not of the form key=value", setting));
        if (std::find(keys_.begin(), keys_.end(), key) == keys_.end())
            fail(fmt::format("\"{}\" is not a key of this model; there are {}", key,
                             fmt::join(keys_, ", ")));
        if (has(key)) fail(fmt::format("{} is given twice", key));
        settings_.emplace_back(key, setting.substr(equals + 1));
    }

    const std::string_view* find(std::string_view key) const {
        for (const auto& [k, value] : settings_)
            if (k == key) return &value;
        return nullptr;
    }

    double to_number(std::string_view key, std::string_view word) const {
        double value = 0;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
            fail(fmt::format("{}: \"{}\" is not a number", key, word));
        return value;
    }

    const std::string& spec_;
    std::vector<std::string_view> keys_;
    std::vector<std::pair<std::string_view, std::string_view>> settings_;
};

std::unique_ptr<Bsdf> parse_lambert(const std::string& spec, std::string_view settings) {
    const SpecReader reader(spec, settings, {"albedo"});
    return std::make_unique<LambertBrdf>(reader.has("albedo") ? reader.list("albedo")
                                                              : std::vector<double>{1.0});
}

std::unique_ptr<Bsdf> parse_cook_torrance(const std::string& spec, std::string_view settings) {
    const SpecReader reader(spec, settings, {"roughness", "metallic", "albedo", "k", "diffuse"});
    CookTorranceSettings s;
    s.roughness = reader.number("roughness");
    s.metallic = reader.number("metallic", s.metallic);
    const std::vector<double> albedo = reader.list("albedo");
    if (albedo.size() > 1 && albedo.size() != 3)
        reader.fail(fmt::format("albedo has {} values, 1 or 3 are taken", albedo.size()));
    for (std::size_t c = 0; c < s.albedo.size() && !albedo.empty(); ++c)
        s.albedo[c] = albedo.size() == 1 ? albedo[0] : albedo[c];
    s.k = reader.choice<GeometryRemap>(
        "k", {{"direct", GeometryRemap::Direct}, {"ibl", GeometryRemap::Ibl}});
    s.diffuse = reader.choice<DiffuseTerm>("diffuse", {{"on", DiffuseTerm::Coupled},
                                                       {"off", DiffuseTerm::Off},
                                                       {"uncoupled", DiffuseTerm::Uncoupled}});
    return std::make_unique<CookTorranceBrdf>(s);
}

std::unique_ptr<Bsdf> parse_microfacet(const std::string& spec, std::string_view settings,
                                       SlopeFamily distribution) {
    const SpecReader reader(
        spec, settings,
        {"alpha", "alpha_y", "masking", "fresnel", "f0", "ior", "k", "material", "wavelengths"});
    MicrofacetSettings s;
    s.distribution = distribution;
    s.alpha_x = reader.number("alpha");
    s.alpha_y = reader.number("alpha_y", s.alpha_x);
    s.masking = reader.choice<Masking>(
        "masking", {{"correlated", Masking::Correlated}, {"separable", Masking::Separable}});
    s.optics.f0 = reader.list("f0");
    s.optics.ior = reader.list("ior");
    s.optics.k = reader.list("k");
    s.optics.material = reader.text("material", "");
    s.optics.wavelengths = reader.list("wavelengths");
    s.optics.fresnel =
        reader.has("fresnel")
            ? reader.choice<FresnelKind>("fresnel", {{"none", FresnelKind::None},
                                                     {"schlick", FresnelKind::Schlick},
                                                     {"dielectric", FresnelKind::Dielectric},
                                                     {"conductor", FresnelKind::Conductor}})
            : implied_fresnel(s.optics);
    return std::make_unique<MicrofacetBrdf>(s);
}

constexpr std::string_view kModels[] = {"lambert", "cook-torrance", "ggx", "beckmann"};

}  // namespace

std::unique_ptr<Bsdf> parse_brdf_spec(const std::string& spec) {
    const std::size_t colon = spec.find(':');
    const std::string model = spec.substr(0, colon);
    const std::string_view settings =
        colon == std::string::npos ? std::string_view{} : std::string_view(spec).substr(colon + 1);
    try {
        if (model == "lambert") return parse_lambert(spec, settings);
        if (model == "cook-torrance") return parse_cook_torrance(spec, settings);
        if (model == "ggx") return parse_microfacet(spec, settings, SlopeFamily::Ggx);
        if (model == "beckmann") return parse_microfacet(spec, settings, SlopeFamily::Beckmann);
    } catch (const Error& e) {
        if (e.where() == spec) throw;
        // The models know their settings; the user knows the specification.
        throw Error(e.code(), fmt::format("{}: {}", e.where(), e.message()), spec);
    }
    throw Error(ErrorCode::Usage,
                fmt::format("\"{}\" is not a model; there are {}", model, fmt::join(kModels, ", ")),
                spec);
}

bool is_brdf_spec(const std::string& spec) {
    const std::string model = spec.substr(0, spec.find(':'));
    return std::find(std::begin(kModels), std::end(kModels), model) != std::end(kModels);
}

}  // namespace asperity

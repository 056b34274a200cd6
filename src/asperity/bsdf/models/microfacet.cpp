// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/models/microfacet_spec.h>
#include <asperity/core/error.h>
#include <asperity/optics/optics_params.h>
#include <asperity/params/fields.h>

#include <fmt/format.h>

namespace asperity {
namespace {

constexpr Range kAlphas = {1e-4, 100};
constexpr Names<Masking, 2> kMaskings = {{
    {"correlated", Masking::Correlated},
    {"separable", Masking::Separable},
}};

void check_alpha(const char* name, double alpha) {
    if (!kAlphas.contains(alpha))
        throw Error(ErrorCode::Usage, fmt::format("{} is not within 0.0001 .. 100", alpha), name);
}

/// The row of the law, open as long as none is named.
Param<MicrofacetSpec> law_row(const Param<OpticsSettings>& row) {
    ParamInfo info = row.info;
    info.absent = "implied";
    return {info,
            [row](const MicrofacetSpec& s) {
                if (!s.fresnel) return ParamValue();
                OpticsSettings optics;
                optics.fresnel = *s.fresnel;
                return row.get(optics);
            },
            [row](MicrofacetSpec& s, const ParamValue& value) {
                OpticsSettings optics;
                s.fresnel.reset();
                if (std::holds_alternative<std::monostate>(value)) return;
                row.set(optics, value);
                s.fresnel = optics.fresnel;
            }};
}

}  // namespace

OpticsSettings MicrofacetSpec::law() const {
    OpticsSettings settings = optics;
    settings.fresnel = fresnel.value_or(implied_fresnel(optics));
    return settings;
}

ParamTable<MicrofacetSpec> microfacet_params() {
    using S = MicrofacetSpec;
    ParamTable<S> table = {
        field(&S::alpha, {.name = "alpha",
                          .range = kAlphas,
                          .doc = "width of the distribution of slopes; Beckmann's is the rms "
                                 "gradient, sqrt(2) times the rms slope along an axis"}),
        field(&S::alpha_y, {.name = "alpha_y",
                            .label = "Alpha along y",
                            .range = kAlphas,
                            .absent = "alpha",
                            .doc = "width along y of an anisotropic surface"}),
        field(&S::masking, kMaskings,
              {.name = "masking",
               .doc = "Smith's: height-correlated (Heitz 2014, eq. 99) or separable (eq. 98)"}),
    };
    const ParamTable<OpticsSettings> optics = optics_params();
    for (const Param<OpticsSettings>& row : optics) {
        if (row.info.name == "fresnel")
            table.push_back(law_row(row));
        else
            append(table, ParamTable<OpticsSettings>{row}, &S::optics);
    }
    return table;
}

std::string microfacet_name(const char* model, double alpha_x, double alpha_y,
                            const std::string& own, Masking masking, const OpticsSettings& optics) {
    check_alpha("alpha", alpha_x);
    check_alpha("alpha_y", alpha_y);
    std::string line = fmt::format("{}:alpha={}", model, alpha_x);
    if (alpha_x != alpha_y) line += fmt::format(",alpha_y={}", alpha_y);
    line += own;
    if (masking == Masking::Separable) line += ",masking=separable";
    for (const Param<OpticsSettings>& row : optics_params()) {
        const std::string value = to_spec_text(row.info, row.text(optics));
        if (value != to_spec_text(row.info, row.default_text()))
            line += "," + row.info.name + "=" + value;
    }
    return line;
}

MicrofacetBrdf::MicrofacetBrdf(const MicrofacetSettings& s)
    : MicrofacetModel(microfacet_name(s.distribution == SlopeFamily::Ggx ? "ggx" : "beckmann",
                                      s.alpha_x, s.alpha_y, "", s.masking, s.optics),
                      {s.distribution, s.alpha_x, s.alpha_y}, s.masking, s.optics) {}

BsdfModel smith_model(SlopeFamily family, std::string name, std::string label, std::string doc) {
    return bsdf_model<MicrofacetSpec>(
        std::move(name), std::move(label), std::move(doc), microfacet_params(),
        [family](const MicrofacetSpec& s) {
            return std::make_unique<MicrofacetBrdf>(
                MicrofacetSettings{family, s.alpha, s.width_y(), s.masking, s.law()});
        },
        {"alpha"});
}

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#include "render_materials.h"

#include "brdf_argument.h"
#include "file_kind.h"

#include <asperity/bsdf/spec.h>
#include <asperity/core/error.h>
#include <asperity/formats/results/result_file.h>
#include <asperity/gonio/experiment_text.h>
#include <asperity/measured/baked_brdf.h>

#include <fmt/format.h>

namespace asperity::cli {

namespace {

constexpr std::size_t kMostBrdfs = 2;  ///< left and right of the split

std::shared_ptr<const Bsdf> load_brdf(const std::string& text, Run& run, io::Provenance& origin) {
    if (is_brdf_spec(text)) return parse_brdf_spec(text);
    if (const auto file = open_brdf(text, io::BsdfFormats())) return bake_brdf(*file, run);
    const auto [m, checksum] = load_result_lobes(text);
    if (m.channels() != 1 && m.channels() != 3) {
        throw Error(ErrorCode::InvalidInput,
                    fmt::format("has {} channels, a picture needs 1 (grey) or 3 (red, green, "
                                "blue): measure with --wavelengths 650,550,450",
                                m.channels()),
                    text);
    }
    origin.emplace_back("experiment", to_text(m.experiment));
    origin.emplace_back("experiment-checksum", checksum);
    return bake_brdf(m, run);
}

}  // namespace

void check_materials(const RenderOptions& options) {
    const std::vector<std::string>& brdfs = options.texts("brdf");
    if (brdfs.size() > kMostBrdfs)
        throw Error(ErrorCode::Usage, fmt::format("given {} times, at most twice", brdfs.size()),
                    "brdf");
    for (const std::string& text : brdfs) {
        if (is_brdf_spec(text)) parse_brdf_spec(text);
        check_brdf_exists(text);
    }
    if (brdfs.size() < kMostBrdfs && options.given("split"))
        throw Error(ErrorCode::Usage, "needs a second --brdf", "split");
    options.value("split").number(kZeroToOne);
    const auto factors = options.two_numbers("normalize-factor", kNotNegative, 1);
    const auto albedos = options.two_colours("albedo", kZeroToOne, {});
    if (brdfs.size() < kMostBrdfs && (factors[1] != 1 || !is_black(albedos[1]))) {
        throw Error(ErrorCode::Usage, "a second value needs a second --brdf",
                    factors[1] != 1 ? "normalize-factor" : "albedo");
    }
    parse_brdf_spec(std::string(options.value("stage").text()));
}

Materials load_materials(const RenderOptions& options, Run& run) {
    check_materials(options);
    const std::vector<std::string>& brdfs = options.texts("brdf");
    const auto factors = options.two_numbers("normalize-factor", kNotNegative, 1);
    const auto albedos = options.two_colours("albedo", kZeroToOne, {});
    io::Provenance origin;
    const auto material = [&](std::size_t k) {
        return Material(load_brdf(brdfs[k], run, origin), {factors[k], albedos[k]});
    };
    Materials materials{material(0),
                        std::nullopt,
                        Material(parse_brdf_spec(std::string(options.value("stage").text()))),
                        {}};
    if (brdfs.size() == kMostBrdfs)
        materials.split = SplitView{material(1), options.value("split").number(kZeroToOne)};
    materials.origin = std::move(origin);
    return materials;
}

}  // namespace asperity::cli

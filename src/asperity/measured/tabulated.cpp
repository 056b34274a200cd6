// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/lattice.h>
#include <asperity/bsdf/models/lambert.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/measured/angle_nodes.h>
#include <asperity/measured/baked_brdf.h>
#include <asperity/measured/cosine_share.h>
#include <asperity/measured/layer_table.h>
#include <asperity/measured/lobe_guide.h>
#include <asperity/measured/tabulated.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace asperity {
namespace {

/// A layer as steep as this [rad] shows the distribution of normals.
constexpr double kNearNormal = 0.2;

using detail::bracket, detail::bracket_round, detail::Bracket;
using detail::distinct, detail::positive_azimuth, detail::refine, detail::kSameAngle;
using detail::kCosineShare;

/// How much a layer is worth where its own light leaves with this cosine: less near the horizon,
/// next to nothing below, but never nothing, so that one layer alone still counts.
double trust_at(double cosine) {
    constexpr double kFull = 0.1;
    return std::clamp(cosine / kFull, 1e-6, 1.0);
}

/// At least two directions for each of so many cells, whose noise the integral has to see, up to
/// the 32,768 of the default detector; with a third as many as cells it was off by up to 0.005.
FibonacciLattice lattice_over(int cells) {
    for (const FibonacciLattice lattice : {kFineLattice, kFinerLattice})
        if (lattice.points >= 2 * cells) return lattice;
    return kFinestLattice;
}

[[noreturn]] void reject(std::string message) {
    throw Error(ErrorCode::InvalidInput, std::move(message), "measurement");
}

void check_stop(const Run& run) {
    if (run.stop_requested()) throw Error(ErrorCode::Stopped, "stopped before the table was made");
}

/// See tabulated.h for what is interpolated how.
class TabulatedBrdf final : public Bsdf {
  public:
    /// Without normalise() until that is called.
    TabulatedBrdf(const Measurement& measurement, const Run& run);
    /// `cells`: of the hemisphere.
    void normalise(int cells, const Run& run);

    int channels() const override { return channels_; }
    std::vector<std::string> channel_names() const override { return channel_names_; }
    std::string name() const override { return name_; }
    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override;
    void eval_at_facets(std::span<const Vec3> wi, std::span<const Vec3> wm,
                        std::span<double> f) const override;
    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override;
    double pdf(Vec3 wi, Vec3 wo) const override;
    void albedo(Vec3 wi, std::span<double> a) const override;
    bool isotropic() const override { return relative_; }

  private:
    /// A layer that has a say.
    struct Corner {
        std::size_t layer = 0;
        double weight = 0;
    };
    using Corners = std::array<Corner, 4>;

    /// Incident light, turned to where the layers have theirs when azimuths are relative.
    struct Light {
        Vec3 wi;
        double turn = 0, theta = 0, phi = 0, sigma = 0;  ///< sigma: of the guide
        Corners corners;
    };

    /// How much what a layer says at a facet is to be trusted, and what its table holds f over.
    struct Said {
        double trust = 0, guide = 1;
    };

    void read_layers(const Measurement& measurement, const Run& run);
    Corners corners(double theta_i, double phi_i) const;
    double turn_of(Vec3 wi) const;
    Light light_from(Vec3 wi) const;
    Said ask(std::size_t layer, Vec3 wm, std::span<double> f) const;
    template <class AskCorner>
    void blend(const Light& light, Vec3 wo, double facets, AskCorner ask_corner,
               std::span<double> f) const;
    void correct(const Light& light, std::span<double> f, std::size_t count) const;
    double pdf_turned(const Corners& corners, Vec3 wi, Vec3 wo) const;

    int channels_;
    std::vector<std::string> channel_names_;
    std::string name_;
    std::vector<double> thetas_, phis_;  ///< of the layers, rising
    std::vector<LayerTable> tables_;     ///< [theta * phis + phi], over the guide
    std::vector<Vec3> lights_;           ///< of the layers, as tables_
    LobeGuide guide_;
    bool relative_ = false;  ///< one azimuth stands for all

    // What brings the albedo of the blend to the blend of the albedos:
    // [(theta * phi nodes + phi) * channels + channel].
    std::vector<double> theta_nodes_, phi_nodes_, corrections_;
};

TabulatedBrdf::TabulatedBrdf(const Measurement& measurement, const Run& run)
    : channels_(measurement.channels()),
      channel_names_(measurement.channel_names),
      name_("tabulated:" + (measurement.surface_name.empty() ? std::string("measurement")
                                                             : measurement.surface_name)) {
    read_layers(measurement, run);
}

void TabulatedBrdf::read_layers(const Measurement& measurement, const Run& run) {
    if (measurement.layers.empty()) reject("has no layers");
    if (channels_ < 1 || channels_ > kMaxBsdfChannels)
        reject(
            fmt::format("has {} channels, 1 .. {} can be tabulated", channels_, kMaxBsdfChannels));
    std::vector<double> thetas, phis;
    for (const Layer& layer : measurement.layers) {
        if (layer.rays == 0) reject(fmt::format("layer {} has no rays", layer.number));
        thetas.push_back(layer.theta_i);
        phis.push_back(positive_azimuth(layer.phi_i));
    }
    thetas_ = distinct(std::move(thetas));
    phis_ = distinct(std::move(phis));
    relative_ = phis_.size() == 1;

    const auto grid = std::make_shared<const CellGrid>(measurement.detector);
    const auto layer_at = [&](double theta, double phi) -> const Layer& {
        for (const Layer& layer : measurement.layers) {
            if (std::abs(layer.theta_i - theta) <= kSameAngle &&
                std::abs(positive_azimuth(layer.phi_i) - phi) <= kSameAngle)
                return layer;
        }
        reject(
            fmt::format("its layers do not form a grid: none at theta {:.6g}, phi {:.6g} degrees",
                        degrees(theta), degrees(phi)));
    };
    std::vector<const Layer*> layers;
    for (const double theta : thetas_) {
        for (const double phi : phis_) {
            layers.push_back(&layer_at(theta, phi));
            lights_.push_back(from_spherical(theta, phi));
        }
    }
    std::vector<std::optional<LayerTable>> tables(layers.size());
    if (thetas_.front() <= kNearNormal) {
        const LayerTable& steepest = tables[0].emplace(grid, measurement, *layers[0]);
        guide_ = LobeGuide(steepest, lights_.front(), run.threads());
        if (guide_.is_known()) tables[0].reset();  // to be made over the guide
    }
    parallel_for(layers.size(), run.threads(), [&](std::size_t k) {
        if (!run.keep_going() || tables[k]) return;
        const Vec3 wi = lights_[k];
        const LobeShape shape = [this, wi, sigma = guide_.sigma(wi)](Vec3 wo) {
            return guide_.facets(wi + wo) / (sigma * guide_.sigma(wo));
        };
        tables[k].emplace(grid, measurement, *layers[k], guide_.is_known() ? shape : nullptr);
    });
    check_stop(run);
    for (std::optional<LayerTable>& table : tables) tables_.push_back(*std::move(table));
}

/// The blend of two lobes keeps neither's energy exactly. At incident directions close enough
/// together, find by how much it misses, while the corrections are still empty.
void TabulatedBrdf::normalise(int cells, const Run& run) {
    // With a second dimension to cover, coarser steps keep the cost of it within seconds.
    const FibonacciLattice lattice = relative_ ? lattice_over(cells) : kCoarseLattice;
    std::vector<double> theta_nodes = refine(thetas_, 0, 0.5 * kPi, radians(relative_ ? 1.5 : 3));
    if (relative_) {  // towards the horizon, where most changes
        for (double deg = 78; deg < 90; deg += deg < 87 ? 0.5 : 0.25)
            theta_nodes.push_back(radians(deg));
        theta_nodes = distinct(std::move(theta_nodes));
    }
    std::vector<double> phi_nodes = phis_;
    if (!relative_) {
        phi_nodes = refine(phis_, phis_.front(), phis_.front() + 2 * kPi, radians(22.5));
        phi_nodes.pop_back();  // the first again
        for (double& phi : phi_nodes) phi = positive_azimuth(phi);
        std::sort(phi_nodes.begin(), phi_nodes.end());
    }

    const std::size_t channels = static_cast<std::size_t>(channels_);
    std::vector<double> corrections(theta_nodes.size() * phi_nodes.size() * channels, 1.0);
    parallel_for(theta_nodes.size() * phi_nodes.size(), run.threads(), [&](std::size_t k) {
        if (!run.keep_going()) return;
        // Light along the surface has no albedo of its own: take it from just above.
        const double theta = std::min(theta_nodes[k / phi_nodes.size()], radians(89.9));
        const Vec3 wi = from_spherical(theta, phi_nodes[k % phi_nodes.size()]);
        std::vector<double> wanted(channels), present(channels);
        albedo(wi, wanted);
        if (relative_ || guide_.is_known())
            guide_.albedo_over_facets(*this, wi, lattice, present);
        else
            albedo_by_sampling(*this, wi, lattice, present);
        for (std::size_t c = 0; c < channels; ++c)
            if (present[c] > 0) corrections[k * channels + c] = wanted[c] / present[c];
    });
    check_stop(run);
    theta_nodes_ = std::move(theta_nodes);
    phi_nodes_ = std::move(phi_nodes);
    corrections_ = std::move(corrections);
}

TabulatedBrdf::Corners TabulatedBrdf::corners(double theta_i, double phi_i) const {
    const Bracket t = bracket(thetas_, theta_i), p = bracket_round(phis_, phi_i);
    const auto corner = [&](std::size_t theta, std::size_t phi, double weight) {
        return Corner{theta * phis_.size() + phi, weight};
    };
    return {corner(t.index, p.index, (1 - t.t) * (1 - p.t)),
            corner(t.index, p.next, (1 - t.t) * p.t), corner(t.next, p.index, t.t * (1 - p.t)),
            corner(t.next, p.next, t.t * p.t)};
}

/// The angle that turns wi to where the layers have their light, when azimuths are relative.
double TabulatedBrdf::turn_of(Vec3 wi) const {
    return relative_ ? phis_.front() - azimuth(wi) : 0.0;
}

TabulatedBrdf::Light TabulatedBrdf::light_from(Vec3 wi) const {
    Light light;
    light.turn = turn_of(wi);
    light.theta = polar_angle(wi);
    light.phi = relative_ ? phis_.front() : azimuth(wi);
    light.wi = rotate_z(wi, light.turn);
    light.sigma = guide_.sigma(light.wi);
    light.corners = corners(light.theta, light.phi);
    return light;
}

/// Every layer is asked for the facet that mirrors wi to wo: there its lobe has the same place.
/// Where the layer's light would have left near or below the horizon, others are trusted.
TabulatedBrdf::Said TabulatedBrdf::ask(std::size_t layer, Vec3 wm, std::span<double> f) const {
    const Vec3 wo = reflect(lights_[layer], wm);
    tables_[layer].eval(wo, f);
    const double trust = trust_at(wo.z);
    // Without a guide the tables hold f itself.
    return {trust, guide_.is_known() ? 1 : guide_(lights_[layer], wo, wm)};
}

/// f from what the layers of the corners say at a facet: ask_corner(layer) gives it and its f.
template <class AskCorner>
void TabulatedBrdf::blend(const Light& light, Vec3 wo, double facets, AskCorner ask_corner,
                          std::span<double> f) const {
    std::fill(f.begin(), f.end(), 0.0);
    double trusted = 0;
    for (const Corner& corner : light.corners) {
        if (corner.weight == 0) continue;
        const auto [said, values] = ask_corner(corner.layer);
        const double trust = corner.weight * said.trust, weight = trust / said.guide;
        for (std::size_t c = 0; c < f.size(); ++c) f[c] += weight * values[c];
        trusted += trust;
    }
    const double scale = facets / (light.sigma * guide_.sigma(wo)) / trusted;
    for (double& value : f) value *= scale;
}

/// Brings `count` f of all channels of one light to the albedo.
void TabulatedBrdf::correct(const Light& light, std::span<double> f, std::size_t count) const {
    if (corrections_.empty()) return;
    const Bracket t = bracket(theta_nodes_, light.theta), p = bracket_round(phi_nodes_, light.phi);
    const std::size_t channels = static_cast<std::size_t>(channels_), phis = phi_nodes_.size();
    for (std::size_t c = 0; c < channels; ++c) {
        const auto at = [&](std::size_t theta, std::size_t phi) {
            return corrections_[(theta * phis + phi) * channels + c];
        };
        const double correction =
            (1 - t.t) * ((1 - p.t) * at(t.index, p.index) + p.t * at(t.index, p.next)) +
            t.t * ((1 - p.t) * at(t.next, p.index) + p.t * at(t.next, p.next));
        for (std::size_t k = 0; k < count; ++k) f[k * channels + c] *= correction;
    }
}

void TabulatedBrdf::eval(Vec3 wi, Vec3 wo, std::span<double> f) const {
    if (wi.z <= 0 || wo.z <= 0) {
        std::fill(f.begin(), f.end(), 0.0);
        return;
    }
    const Light light = light_from(wi);
    const Vec3 wo_turned = rotate_z(wo, light.turn), wm = normalize(light.wi + wo_turned);
    std::array<double, kMaxBsdfChannels> values;
    const std::span<double> said = std::span(values).first(f.size());
    const auto ask_corner = [&](std::size_t layer) {
        return std::pair(ask(layer, wm, said), values.data());
    };
    blend(light, wo_turned, guide_.facets(wm), ask_corner, f);
    correct(light, f, 1);
}

/// What a layer says at a facet is the same for any light.
void TabulatedBrdf::eval_at_facets(std::span<const Vec3> wi, std::span<const Vec3> wm,
                                   std::span<double> f) const {
    const std::size_t channels = static_cast<std::size_t>(channels_), facets = wm.size();
    std::vector<Said> said(tables_.size() * facets);
    std::vector<double> values(said.size() * channels), guided(facets);
    std::vector<Vec3> turned(facets);
    const auto ask_all = [&](double turn) {
        for (std::size_t k = 0; k < facets; ++k) {
            turned[k] = rotate_z(wm[k], turn);
            guided[k] = guide_.facets(turned[k]);
            for (std::size_t layer = 0; layer < tables_.size(); ++layer) {
                const std::size_t place = layer * facets + k;
                said[place] =
                    ask(layer, turned[k], std::span(values).subspan(place * channels, channels));
            }
        }
    };
    std::optional<double> turn;  // of the light before
    for (std::size_t n = 0; n < wi.size(); ++n) {
        const Light light = light_from(wi[n]);
        if (turn != light.turn) ask_all(light.turn);
        turn = light.turn;
        const std::span<double> all = f.subspan(n * facets * channels, facets * channels);
        for (std::size_t k = 0; k < facets; ++k) {
            const std::span<double> here = all.subspan(k * channels, channels);
            const Vec3 wo = reflect(light.wi, turned[k]);
            if (light.wi.z <= 0 || wo.z <= 0) {
                std::fill(here.begin(), here.end(), 0.0);
                continue;
            }
            const auto ask_corner = [&](std::size_t layer) {
                const std::size_t place = layer * facets + k;
                return std::pair(said[place], values.data() + place * channels);
            };
            blend(light, wo, guided[k], ask_corner, here);
        }
        correct(light, all, facets);
    }
}

std::optional<BsdfSample> TabulatedBrdf::sample(Vec3 wi, double u1, double u2) const {
    if (wi.z <= 0) return std::nullopt;
    const double turn = turn_of(wi);
    const Vec3 wi_turned = rotate_z(wi, turn);
    const Corners all = corners(polar_angle(wi), relative_ ? phis_.front() : azimuth(wi));

    Vec3 wo;
    if (u1 < kCosineShare) {
        wo = sample_cosine(u1 / kCosineShare, u2);
    } else {
        // Choose a layer by its weight, a direction from its table, and mirror wi at the facet
        // that would have sent the layer's light there.
        double u = (u1 - kCosineShare) / (1 - kCosineShare);
        std::size_t k = 0;
        for (std::size_t next = 1; next < all.size(); ++next) {
            if (all[next].weight == 0) continue;
            if (u < all[k].weight) break;
            u -= all[k].weight;
            k = next;
        }
        u = std::clamp(u / all[k].weight, 0.0, std::nextafter(1.0, 0.0));
        const std::size_t layer = all[k].layer;
        const Vec3 wm = normalize(lights_[layer] + tables_[layer].sample(u, u2));
        wo = reflect(wi_turned, wm);
    }
    if (wo.z <= 0) return std::nullopt;
    return BsdfSample{rotate_z(wo, -turn), pdf_turned(all, wi_turned, wo)};
}

double TabulatedBrdf::pdf(Vec3 wi, Vec3 wo) const {
    if (wi.z <= 0 || wo.z <= 0) return 0;
    const double turn = turn_of(wi);
    return pdf_turned(corners(polar_angle(wi), relative_ ? phis_.front() : azimuth(wi)),
                      rotate_z(wi, turn), rotate_z(wo, turn));
}

double TabulatedBrdf::pdf_turned(const Corners& all, Vec3 wi, Vec3 wo) const {
    const Vec3 wm = normalize(wi + wo);
    double density = 0;
    for (const Corner& corner : all) {
        // dwo = 4 (w . wm) dwm for either incident direction.
        const Vec3 light = lights_[corner.layer];
        const double jacobian = dot(light, wm) / dot(wi, wm);
        if (corner.weight > 0 && jacobian > 0)
            density += corner.weight * tables_[corner.layer].pdf(reflect(light, wm)) * jacobian;
    }
    return kCosineShare * wo.z / kPi + (1 - kCosineShare) * density;
}

void TabulatedBrdf::albedo(Vec3 wi, std::span<double> a) const {
    std::fill(a.begin(), a.end(), 0.0);
    if (wi.z <= 0) return;
    for (const Corner& corner : corners(polar_angle(wi), relative_ ? phis_.front() : azimuth(wi)))
        for (std::size_t c = 0; c < a.size(); ++c)
            a[c] += corner.weight * tables_[corner.layer].albedo(c);
}

}  // namespace

std::unique_ptr<Bsdf> make_tabulated_brdf(const Measurement& measurement, const Run& run) {
    auto table = std::make_unique<TabulatedBrdf>(measurement, run);
    table->normalise(measurement.detector.cells(), run);
    return table;
}

std::shared_ptr<const BakedBrdf> bake_brdf(const Measurement& measurement, Run& run,
                                           const BakeSettings& settings) {
    // Baking finds factors of its own, so those of normalise() would cancel.
    return bake_brdf(TabulatedBrdf(measurement, run), run, settings);
}

std::unique_ptr<Bsdf> make_tabulated_brdf(const Measurement& measurement) {
    return make_tabulated_brdf(measurement, Run());
}

}  // namespace asperity

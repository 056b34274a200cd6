// SPDX-License-Identifier: Apache-2.0
#include <asperity/bsdf/lattice.h>
#include <asperity/bsdf/models/lambert.h>
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
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

constexpr double kSameAngle = 1e-9;  ///< [rad]

/// A layer as steep as this [rad] shows the distribution of normals.
constexpr double kNearNormal = 0.2;

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

/// A value between nodes of a sorted list: nodes `index` and `next` with weights 1 - t and t.
struct Bracket {
    std::size_t index = 0, next = 0;
    double t = 0;
};

/// Clamps to the ends of the list.
Bracket bracket(std::span<const double> nodes, double x) {
    if (x <= nodes.front()) return {0, 0, 0};
    const std::size_t last = nodes.size() - 1;
    if (x >= nodes.back()) return {last, last, 0};
    const auto above = std::upper_bound(nodes.begin(), nodes.end(), x);
    const std::size_t index = static_cast<std::size_t>(above - nodes.begin()) - 1;
    return {index, index + 1, (x - nodes[index]) / (nodes[index + 1] - nodes[index])};
}

/// Runs round from the last node to the first; x and the nodes in [0, 2 pi).
Bracket bracket_round(std::span<const double> nodes, double x) {
    const std::size_t last = nodes.size() - 1;
    if (last == 0) return {0, 0, 0};
    if (x >= nodes.front() && x < nodes.back()) return bracket(nodes, x);
    const double gap = nodes.front() + 2 * kPi - nodes.back();
    const double beyond = x >= nodes.back() ? x - nodes.back() : x + 2 * kPi - nodes.back();
    return {last, 0, beyond / gap};
}

/// The nodes and, between them, as many more as keep neighbours within `spacing`; from `low` to
/// `high`.
std::vector<double> refine(std::vector<double> nodes, double low, double high, double spacing) {
    if (nodes.front() > low) nodes.insert(nodes.begin(), low);
    if (nodes.back() < high) nodes.push_back(high);
    std::vector<double> fine;
    for (std::size_t k = 0; k + 1 < nodes.size(); ++k) {
        const int parts = std::max(
            1, static_cast<int>(std::ceil((nodes[k + 1] - nodes[k]) / spacing - kSameAngle)));
        for (int p = 0; p < parts; ++p)
            fine.push_back(nodes[k] + (nodes[k + 1] - nodes[k]) * p / parts);
    }
    fine.push_back(nodes.back());
    return fine;
}

/// Sorted, without repetitions.
std::vector<double> distinct(std::vector<double> angles) {
    std::sort(angles.begin(), angles.end());
    std::vector<double> result;
    for (const double a : angles)
        if (result.empty() || a - result.back() > kSameAngle) result.push_back(a);
    return result;
}

double positive_azimuth(double phi) {
    const double turned = std::fmod(phi, 2 * kPi);
    const double positive = turned < -kSameAngle ? turned + 2 * kPi : std::max(0.0, turned);
    return positive < 2 * kPi - kSameAngle ? positive : 0.0;
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
    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override;
    double pdf(Vec3 wi, Vec3 wo) const override;
    void albedo(Vec3 wi, std::span<double> a) const override;
    bool isotropic() const override { return relative_; }

  private:
    /// A layer that has a say, and the direction its light came from.
    struct Corner {
        const LayerTable* table = nullptr;
        Vec3 wi;
        double weight = 0;
    };
    using Corners = std::array<Corner, 4>;

    void read_layers(const Measurement& measurement, const Run& run);
    Corners corners(double theta_i, double phi_i) const;
    double turn_of(Vec3 wi) const;
    double pdf_turned(const Corners& corners, Vec3 wi, Vec3 wo) const;

    int channels_;
    std::vector<std::string> channel_names_;
    std::string name_;
    std::vector<double> thetas_, phis_;  ///< of the layers, rising
    std::vector<LayerTable> tables_;     ///< [theta * phis + phi], over the guide
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
    for (const double theta : thetas_)
        for (const double phi : phis_) layers.push_back(&layer_at(theta, phi));
    std::vector<std::optional<LayerTable>> tables(layers.size());
    if (thetas_.front() <= kNearNormal) {
        const LayerTable& steepest = tables[0].emplace(grid, measurement, *layers[0]);
        guide_ = LobeGuide(steepest, from_spherical(thetas_.front(), phis_.front()));
        if (guide_.is_known()) tables[0].reset();  // to be made over the guide
    }
    parallel_for(layers.size(), run.threads(), [&](std::size_t k) {
        if (!run.keep_going() || tables[k]) return;
        const Vec3 wi = from_spherical(thetas_[k / phis_.size()], phis_[k % phis_.size()]);
        const LobeShape shape = [&](Vec3 wo) { return guide_(wi, wo, wi + wo); };
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
        return Corner{&tables_[theta * phis_.size() + phi],
                      from_spherical(thetas_[theta], phis_[phi]), weight};
    };
    return {corner(t.index, p.index, (1 - t.t) * (1 - p.t)),
            corner(t.index, p.next, (1 - t.t) * p.t), corner(t.next, p.index, t.t * (1 - p.t)),
            corner(t.next, p.next, t.t * p.t)};
}

/// The angle that turns wi to where the layers have their light, when azimuths are relative.
double TabulatedBrdf::turn_of(Vec3 wi) const {
    return relative_ ? phis_.front() - azimuth(wi) : 0.0;
}

void TabulatedBrdf::eval(Vec3 wi, Vec3 wo, std::span<double> f) const {
    std::fill(f.begin(), f.end(), 0.0);
    if (wi.z <= 0 || wo.z <= 0) return;
    const double turn = turn_of(wi), theta_i = polar_angle(wi);
    const double phi_i = relative_ ? phis_.front() : azimuth(wi);
    const Vec3 wi_turned = rotate_z(wi, turn), wo_turned = rotate_z(wo, turn);
    const Vec3 wm = normalize(wi_turned + wo_turned);

    // Ask every layer for the facet that mirrors wi to wo: there its lobe has the same place. Where
    // the layer's light would have left near or below the horizon, trust the other layers.
    std::array<double, kMaxBsdfChannels> values{};
    const std::span<double> layer_f = std::span(values).first(f.size());
    double trusted = 0;
    for (const Corner& corner : corners(theta_i, phi_i)) {
        if (corner.weight == 0) continue;
        const Vec3 wo_there = reflect(corner.wi, wm);
        corner.table->eval(wo_there, layer_f);
        const double trust = corner.weight * trust_at(wo_there.z);
        // Without a guide the tables hold f itself.
        const double weight = guide_.is_known() ? trust : trust / guide_(corner.wi, wo_there, wm);
        for (std::size_t c = 0; c < f.size(); ++c) f[c] += weight * layer_f[c];
        trusted += trust;
    }
    const double scale = guide_(wi_turned, wo_turned, wm) / trusted;
    for (double& value : f) value *= scale;

    if (corrections_.empty()) return;
    const Bracket t = bracket(theta_nodes_, theta_i), p = bracket_round(phi_nodes_, phi_i);
    const std::size_t channels = f.size(), phis = phi_nodes_.size();
    for (std::size_t c = 0; c < channels; ++c) {
        const auto at = [&](std::size_t theta, std::size_t phi) {
            return corrections_[(theta * phis + phi) * channels + c];
        };
        f[c] *= (1 - t.t) * ((1 - p.t) * at(t.index, p.index) + p.t * at(t.index, p.next)) +
                t.t * ((1 - p.t) * at(t.next, p.index) + p.t * at(t.next, p.next));
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
        const Vec3 wm = normalize(all[k].wi + all[k].table->sample(u, u2));
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
        const double jacobian = dot(corner.wi, wm) / dot(wi, wm);
        if (corner.weight > 0 && jacobian > 0)
            density += corner.weight * corner.table->pdf(reflect(corner.wi, wm)) * jacobian;
    }
    return kCosineShare * wo.z / kPi + (1 - kCosineShare) * density;
}

void TabulatedBrdf::albedo(Vec3 wi, std::span<double> a) const {
    std::fill(a.begin(), a.end(), 0.0);
    if (wi.z <= 0) return;
    for (const Corner& corner : corners(polar_angle(wi), relative_ ? phis_.front() : azimuth(wi)))
        for (std::size_t c = 0; c < a.size(); ++c) a[c] += corner.weight * corner.table->albedo(c);
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

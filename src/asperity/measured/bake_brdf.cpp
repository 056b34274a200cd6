// SPDX-License-Identifier: Apache-2.0
// Makes the tables of a BakedBrdf, in the order of bake_brdf at the end.
#include <asperity/core/directions.h>
#include <asperity/core/error.h>
#include <asperity/core/parallel.h>
#include <asperity/measured/baked_brdf.h>
#include <asperity/measured/baked_tables.h>
#include <asperity/measured/hemisphere_weights.h>

#include <fmt/format.h>

#include <limits>
#include <optional>

namespace asperity {

/// Fills the tables of one Bsdf step by step.
class BrdfBaker {
  public:
    using Tables = BakedBrdf::Tables;

    BrdfBaker(const Bsdf& brdf, Run& run, const BakeSettings& settings);

    std::shared_ptr<const Tables> bake();

  private:
    void for_each(std::size_t count, const std::function<void(std::size_t)>& body);
    void evaluate(std::size_t row);
    void fill_along_theta();
    void fill_towards_centre(std::size_t slice);
    void find_correction(std::size_t fine);
    void make_sampling(std::size_t slice);

    Vec3 half_vector(std::size_t node) const;
    Vec3 incident(std::size_t slice) const;
    float* values(std::size_t slice, std::size_t node) const;

    const Bsdf& brdf_;
    Run& run_;
    std::shared_ptr<Tables> tables_ = std::make_shared<Tables>();
    Tables& t_ = *tables_;
    std::vector<Vec3> facets_;  ///< half vectors of the nodes
    std::vector<Vec3> lights_;  ///< of the slices
    std::optional<HemisphereWeights> weights_;
    std::vector<float> found_;  ///< corrections; those of the tables are 1 while they are sought
};

namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// Light along the surface has no BRDF of its own: take that from just above.
const double kLeastCosine = std::cos(radians(89.9));

/// The slope of half vectors at which a lobe has fallen to half its height, seen from wi, in the
/// mean of all azimuths; 1 when it never does.
double half_width(const Bsdf& brdf, Vec3 wi) {
    constexpr double kLeast = 1e-3, kGrowth = 1.15;
    constexpr int kAzimuths = 16;
    std::array<double, kMaxBsdfChannels> f{};
    const std::span<double> channels =
        std::span(f).first(static_cast<std::size_t>(brdf.channels()));
    double peak = 0;
    for (double slope = kLeast; slope < 1; slope *= kGrowth) {
        double sum = 0;
        int seen = 0;
        for (int a = 0; a < kAzimuths; ++a) {
            const Vec3 h = from_spherical(std::atan(slope), 2 * kPi * (a + 0.5) / kAzimuths);
            const Vec3 wo = reflect(wi, h);
            if (wo.z <= 0) continue;
            brdf.eval(wi, wo, channels);
            for (const double value : channels) sum += value * (wi.z + wo.z);
            ++seen;
        }
        if (seen == 0) break;
        peak = std::max(peak, sum / seen);
        if (sum / seen < 0.5 * peak) return slope;
    }
    return 1;
}

/// The stretch that suits the narrowest lobe: a GGX lobe gets about its alpha.
double stretch_for(const Bsdf& brdf) {
    constexpr double kLeast = 0.005, kHalfWidthOfGgx = 0.64;
    double width = 1;
    for (const double theta_deg : {0.0, 30.0, 60.0}) {
        for (int a = 0; a < (brdf.isotropic() ? 1 : 4); ++a) {
            width = std::min(width,
                             half_width(brdf, from_spherical(radians(theta_deg), radians(45 * a))));
        }
    }
    return std::clamp(width / kHalfWidthOfGgx, kLeast, 1.0);
}

void expect_within(const char* setting, int value, int least, int most) {
    if (value >= least && value <= most) return;
    throw Error(ErrorCode::Usage, fmt::format("{} is outside {} .. {}", value, least, most),
                setting);
}

}  // namespace

double BakedBrdf::Tables::cosine_at(double theta) const {
    // Halve the interval: polar_place falls with the cosine.
    const double wanted = theta / (thetas - 1);
    double low = 0, high = 1;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (polar_place(middle) > wanted ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

Vec3 BakedBrdf::Tables::incident_at(double theta, double phi) const {
    const double cosine = std::max(kLeastCosine, cosine_at(theta));
    const double sine = std::sqrt(1 - cosine * cosine);
    if (isotropic) return {sine, 0, cosine};
    const double place = 4 * phi / phis;
    const double quarter = std::floor(place), t = place - quarter;
    // A point of the square |x| + |y| = 1, quarter by quarter.
    double x = 1 - t, y = t;
    for (int k = 0; k < static_cast<int>(quarter); ++k) {
        const double turned = x;
        x = -y;
        y = turned;
    }
    const double r = std::hypot(x, y);
    return {sine * x / r, sine * y / r, cosine};
}

BrdfBaker::BrdfBaker(const Bsdf& brdf, Run& run, const BakeSettings& settings)
    : brdf_(brdf), run_(run) {
    if (brdf.channels() != 1 && brdf.channels() != 3) {
        throw Error(ErrorCode::Usage,
                    fmt::format("{} has {} channels, a picture is made of 1 (grey) or 3 (red, "
                                "green, blue)",
                                brdf.name(), brdf.channels()),
                    "brdf");
    }
    t_.isotropic = brdf.isotropic();
    t_.channels = brdf.channels();
    t_.map.stretch = stretch_for(brdf);
    const bool narrow = t_.map.stretch < 0.04;
    t_.thetas = settings.theta_nodes ? settings.theta_nodes : t_.isotropic ? 48 : 32;
    t_.side = settings.resolution ? settings.resolution
              : t_.isotropic      ? (narrow ? 128 : 96)
                                  : (narrow ? 96 : 64);
    t_.phis = t_.isotropic ? 1 : settings.phi_nodes ? settings.phi_nodes : 32;
    expect_within("theta_nodes", t_.thetas, 8, 256);
    expect_within("resolution", t_.side, 16, 512);
    if (!t_.isotropic) expect_within("phi_nodes", t_.phis, 8, 128);
}

Vec3 BrdfBaker::half_vector(std::size_t node) const {
    const std::size_t side = static_cast<std::size_t>(t_.side);
    return normalize(t_.map.half_vector(t_.position(static_cast<double>(node % side)),
                                        t_.position(static_cast<double>(node / side))));
}

Vec3 BrdfBaker::incident(std::size_t slice) const {
    const std::size_t phis = static_cast<std::size_t>(t_.phis);
    return t_.incident_at(static_cast<double>(slice / phis), static_cast<double>(slice % phis));
}

float* BrdfBaker::values(std::size_t slice, std::size_t node) const {
    return &t_.nodes[(slice * t_.nodes_per_slice() + node) * t_.record()];
}

/// Asks the Bsdf at every half vector of a row that mirrors the light of a slice upwards.
void BrdfBaker::evaluate(std::size_t row) {
    const std::size_t side = static_cast<std::size_t>(t_.side);
    const std::size_t channels = static_cast<std::size_t>(t_.channels);
    std::vector<std::size_t> nodes;
    std::vector<Vec3> facets;
    for (std::size_t node = row * side; node < (row + 1) * side; ++node) {
        if (facets_[node].z <= 0) continue;
        nodes.push_back(node);
        facets.push_back(facets_[node]);
    }
    std::vector<double> f(lights_.size() * facets.size() * channels);
    brdf_.eval_at_facets(lights_, facets, f);
    for (std::size_t slice = 0; slice < lights_.size(); ++slice) {
        const Vec3 wi = lights_[slice];
        std::fill_n(values(slice, row * side), side * t_.record(), kUnknown);
        for (std::size_t k = 0; k < facets.size(); ++k) {
            const Vec3 wo = reflect(wi, facets[k]);
            if (wo.z <= 0) continue;
            const double* const found = f.data() + (slice * facets.size() + k) * channels;
            float* const value = values(slice, nodes[k]);
            for (std::size_t c = 0; c < channels; ++c)
                value[c] = static_cast<float>(found[c] * (wi.z + wo.z));
        }
    }
}

/// A node below the horizon is asked for where its cell, or its slice, reaches above: it takes the
/// value of the nearest incident angle at which its half vector does mirror upwards.
void BrdfBaker::fill_along_theta() {
    const std::size_t phis = static_cast<std::size_t>(t_.phis), slices = t_.slices();
    const auto take = [&](std::size_t to, std::size_t from) {
        for (std::size_t node = 0; node < t_.nodes_per_slice(); ++node) {
            float* value = values(to, node);
            if (std::isnan(*value)) std::copy_n(values(from, node), t_.channels, value);
        }
    };
    for (std::size_t k = phis; k < slices; ++k) take(k, k - phis);
    for (std::size_t k = slices - phis; k-- > 0;) take(k, k + phis);
}

/// What no incident angle reaches borders on what some do: it takes the value of the first known
/// node on the way to the centre.
void BrdfBaker::fill_towards_centre(std::size_t slice) {
    const double middle = 0.5 * (t_.side - 1);
    const int side = t_.side;
    const auto node_at = [side](double x, double y) {
        return static_cast<std::size_t>(static_cast<int>(y + 0.5) * side +
                                        static_cast<int>(x + 0.5));
    };
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            float* value = values(slice, node_at(column, row));
            if (!std::isnan(*value)) continue;
            const double away = std::hypot(column - middle, row - middle);
            const float* other = value;
            for (double step = 1; std::isnan(*other); ++step) {
                const double left = std::max(0.0, 1 - step / away);
                other = values(slice, node_at(middle + left * (column - middle),
                                              middle + left * (row - middle)));
            }
            std::copy_n(other, t_.channels, value);
        }
    }
}

/// The integral of what the table says over the whole hemisphere, beside the albedo it should be.
void BrdfBaker::find_correction(std::size_t fine) {
    const std::size_t columns = static_cast<std::size_t>(t_.fine_phis());
    const Vec3 wi = t_.incident_at(static_cast<double>(fine / columns) / Tables::kFine,
                                   static_cast<double>(fine % columns) / Tables::kFine);
    const std::size_t channels = static_cast<std::size_t>(t_.channels);
    std::array<double, 3> wanted{}, sum{};
    brdf_.albedo(wi, std::span(wanted).first(channels));

    const std::vector<double> weights = weights_->of(wi);
    const auto add = [&](std::size_t slice, double share) {
        const float* value = values(slice, 0);
        for (std::size_t node = 0; node < weights.size(); ++node, value += t_.record())
            for (std::size_t c = 0; c < channels; ++c)
                sum[c] += share * weights[node] * static_cast<double>(value[c]);
    };
    const Tables::Incidence in = t_.incidence(wi);
    const auto add_all = [&](const auto& shares) {
        for (std::size_t k = 0; k < shares.kCount; ++k)
            if (shares.weight[k] > 0) add(shares.slice[k], shares.weight[k]);
    };
    t_.isotropic ? add_all(t_.shares<true>(in)) : add_all(t_.shares<false>(in));
    for (std::size_t c = 0; c < channels; ++c) {
        t_.albedos[fine * channels + c] = static_cast<float>(wanted[c]);
        found_[fine * channels + c] = sum[c] > 0 ? static_cast<float>(wanted[c] / sum[c]) : 1.0f;
    }
}

/// Cells are drawn in proportion to the light they send out, the mean of their corners.
void BrdfBaker::make_sampling(std::size_t slice) {
    const Vec3 wi = lights_[slice];
    const std::size_t side = static_cast<std::size_t>(t_.side), cells = side - 1;
    std::vector<double> light(t_.nodes_per_slice(), 0.0);
    for (std::size_t node = 0; node < light.size(); ++node) {
        const Vec3 h = facets_[node], wo = reflect(wi, h);
        if (h.z <= 0 || wo.z <= 0) continue;
        const float* value = values(slice, node);
        double sum = 0;
        for (int c = 0; c < t_.channels; ++c) sum += static_cast<double>(value[c]);
        light[node] = sum * wo.z / ((wi.z + wo.z) * t_.map.place(wi + wo).density);
    }
    std::vector<double> weights(cells * cells), rows(cells, 0.0);
    double total = 0;
    for (std::size_t k = 0; k < weights.size(); ++k) {
        const std::size_t corner = k / cells * side + k % cells;
        weights[k] =
            light[corner] + light[corner + 1] + light[corner + side] + light[corner + side + 1];
        rows[k / cells] += weights[k];
        total += weights[k];
    }
    if (!(total > 0)) {  // a black slice: any cell is as good as another
        std::fill(weights.begin(), weights.end(), 1.0);
        std::fill(rows.begin(), rows.end(), static_cast<double>(cells));
        total = static_cast<double>(weights.size());
    }
    const double area = t_.position(1) - t_.position(0);
    double above = 0;
    for (std::size_t row = 0; row < cells; ++row) {
        double before = 0;
        for (std::size_t column = 0; column < cells; ++column) {
            const double weight = weights[row * cells + column];
            before += weight;
            t_.cells[(slice * cells + row) * cells + column] =
                static_cast<float>(rows[row] > 0 ? before / rows[row] : 0.0);
            values(slice, row * side + column)[t_.channels] =
                static_cast<float>(weight / (total * area * area));
        }
        above += rows[row];
        t_.rows[slice * cells + row] = static_cast<float>(above / total);
    }
    // Nodes of the last row and column begin no cell.
    for (std::size_t k = 0; k < side; ++k) {
        values(slice, k * side + cells)[t_.channels] = 0;
        values(slice, cells * side + k)[t_.channels] = 0;
    }
}

void BrdfBaker::for_each(std::size_t count, const std::function<void(std::size_t)>& body) {
    parallel_for(count, run_.threads(), [&](std::size_t k) {
        if (!run_.keep_going()) return;
        body(k);
        run_.advance(1);
    });
    if (run_.stop_requested()) throw Error(ErrorCode::Stopped, "stopped while preparing the BRDF");
}

std::shared_ptr<const BakedBrdf::Tables> BrdfBaker::bake() {
    const std::size_t slices = t_.slices(), cells = t_.cells_per_row();
    const std::size_t fines =
        static_cast<std::size_t>(t_.fine_thetas()) * static_cast<std::size_t>(t_.fine_phis());
    t_.nodes.resize(slices * t_.nodes_per_slice() * t_.record());
    t_.rows.resize(slices * cells);
    t_.cells.resize(slices * cells * cells);
    t_.corrections.assign(fines * static_cast<std::size_t>(t_.channels), 1.0f);
    found_ = t_.albedos = t_.corrections;

    for (std::size_t node = 0; node < t_.nodes_per_slice(); ++node)
        facets_.push_back(half_vector(node));
    for (std::size_t slice = 0; slice < slices; ++slice) lights_.push_back(incident(slice));
    weights_.emplace(t_.map, t_.side);

    const std::size_t side = static_cast<std::size_t>(t_.side);
    run_.begin("preparing the BRDF", side + 2 * slices + fines);
    for_each(side, [this](std::size_t k) { evaluate(k); });
    fill_along_theta();
    for_each(slices, [this](std::size_t k) { fill_towards_centre(k); });
    for_each(fines, [this](std::size_t k) { find_correction(k); });
    t_.corrections = std::move(found_);
    for_each(slices, [this](std::size_t k) { make_sampling(k); });
    run_.end();
    return tables_;
}

std::shared_ptr<const BakedBrdf> bake_brdf(const Bsdf& brdf, Run& run,
                                           const BakeSettings& settings) {
    BrdfBaker baker(brdf, run, settings);
    std::shared_ptr<BakedBrdf> baked(new BakedBrdf);
    baked->channels_ = brdf.channels();
    baked->isotropic_ = brdf.isotropic();
    baked->name_ = brdf.name();
    baked->tables_ = baker.bake();
    return baked;
}

}  // namespace asperity

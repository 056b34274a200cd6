// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/core/vec.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace asperity {

/// Largest number of channels of a Bsdf.
inline constexpr int kMaxBsdfChannels = 64;

/// A direction drawn by Bsdf::sample and the density it was drawn with [1/sr].
struct BsdfSample {
    Vec3 wo;
    double pdf = 0;
};

/// How a surface reflects: f(wi, wo) in 1/sr, never including a cosine.
///
/// wi and wo are unit vectors pointing away from the surface; wi is where the light comes from, z
/// the normal. Directions at or below the horizon (z <= 0) give f = 0 and pdf = 0. Channels are
/// as in OpticsSettings. All functions are const, thread-safe and free of allocation.
class Bsdf {
  public:
    virtual ~Bsdf() = default;

    virtual int channels() const = 0;
    /// One name each, as OpticsSettings has them: "all" for one, "R", "G", "B", or wavelengths,
    /// "550nm", where the model or its file says them; else "c1", "c2", ...
    virtual std::vector<std::string> channel_names() const;
    /// One line that names the model and its parameters, as parse_brdf_spec reads it.
    virtual std::string name() const = 0;

    /// Writes f(wi, wo) [1/sr] per channel; f.size() == channels().
    virtual void eval(Vec3 wi, Vec3 wo, std::span<double> f) const = 0;

    /// eval() for several wo: f[k * channels() + c]. Models that do so quicker override it.
    virtual void eval_many(Vec3 wi, std::span<const Vec3> wo, std::span<double> f) const;

    /// f(wi, wo) for light from each wi that each facet mirrors, wo = reflect(wi, wm), wm.z > 0:
    /// f[(light * facets + facet) * channels() + c]. May allocate. Models that look up what belongs
    /// to a facet override it.
    virtual void eval_at_facets(std::span<const Vec3> wi, std::span<const Vec3> wm,
                                std::span<double> f) const;

    /// Draws wo for this wi from two numbers uniform in [0, 1); none when the sample falls where f
    /// must be 0. E[f cos(theta_o) / pdf] = albedo.
    virtual std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const = 0;

    /// Density of sample() [1/sr]; its integral over the hemisphere is 1 less the share of none.
    virtual double pdf(Vec3 wi, Vec3 wo) const = 0;

    /// eval() and the density that pdf() gives, at once: models that look both up in one place
    /// override it.
    virtual double eval_pdf(Vec3 wi, Vec3 wo, std::span<double> f) const {
        eval(wi, wo, f);
        return pdf(wi, wo);
    }

    /// Directional albedo: the integral of f cos(theta_o) over wo, per channel. The default
    /// integrates numerically (relative error below 1e-3 for alpha >= 0.05): E[f cos(theta_o) /
    /// pdf] over 10946 points.
    virtual void albedo(Vec3 wi, std::span<double> a) const;

    /// True when turning wi and wo together about z never changes f.
    virtual bool isotropic() const { return false; }

    /// True when mirroring wi and wo in the plane of incidence never changes f either; asked of
    /// isotropic models only, whose averages over cells then cost half.
    virtual bool bilateral() const { return false; }

    /// Incident polar angles [rad], rising, at which a table holds what was measured; between them
    /// it interpolates. Empty: it has none of its own.
    virtual std::vector<double> incident_angles() const { return {}; }

    /// Of models made of facets: the density D(wm) of their normals [1/sr], whose integral over the
    /// projected solid angle is 1 (Walter et al. 2007, eq. 4). None: the model has no facets.
    virtual std::optional<double> normal_density(Vec3) const { return std::nullopt; }
};

}  // namespace asperity

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/core/run.h>

#include <memory>
#include <string>
#include <vector>

namespace asperity {

struct Measurement;

/// How finely bake_brdf tabulates; 0: as fine as the lobe needs, as given last, for isotropic BRDFs
/// (more for a lobe below alpha 0.04) and for others.
struct BakeSettings {
    int theta_nodes = 0;  ///< incident polar angles, 8 .. 256, denser towards the horizon; 48, 32
    int phi_nodes = 0;    ///< incident azimuths when not isotropic, 8 .. 128; 32
    int resolution = 0;   ///< half vectors on a side of the square, 16 .. 512; 96 or 128, 64 or 96
};

/// Any Bsdf as one table made to be shaded with: evaluated in a few dozen nanoseconds, however dear
/// the original (a measured one takes a microsecond), and sampled with a matching density.
///
/// f (cos_i + cos_o), smooth where f is not, in floats over (theta_i [, phi_i], half vector); the
/// half vector on a square by a map without trigonometry, drawn out by the width of the lobe: a
/// narrow lobe on a broad one is kept, but the broad one is then coarse at its edge. Linear in all
/// of them. Sampling draws a half vector from the table of the nearest smaller or larger theta_i,
/// at random in proportion, and one in ten directions from a cosine.
///
/// albedo() is that of the original; the integral of f cos(theta_o) agrees with it within 1e-3 at
/// every theta_i up to 85 degrees, per channel; within 3e-3 when not isotropic. Analytic lobes of
/// alpha 0.01 .. 1 are met within 0.005 of their energy. Channels are the original's, 1 or 3. 4
/// bytes a value and channel, 8 a value for the sampling: 5 to 9 MB when isotropic, 50 to 84 MB
/// when not.
class BakedBrdf final : public Bsdf {
  public:
    int channels() const override { return channels_; }
    std::string name() const override { return name_; }  ///< of the original
    void eval(Vec3 wi, Vec3 wo, std::span<double> f) const override;
    std::optional<BsdfSample> sample(Vec3 wi, double u1, double u2) const override;
    double pdf(Vec3 wi, Vec3 wo) const override;
    void albedo(Vec3 wi, std::span<double> a) const override;
    bool isotropic() const override { return isotropic_; }

    double eval_pdf(Vec3 wi, Vec3 wo, std::span<double> f) const override;  ///< one look

  private:
    friend std::shared_ptr<const BakedBrdf> bake_brdf(const Bsdf&, Run&, const BakeSettings&);
    friend class BrdfBaker;
    struct Tables;

    BakedBrdf() = default;
    int channels_ = 1;
    bool isotropic_ = true;
    std::string name_;
    std::shared_ptr<const Tables> tables_;
};

/// Bakes a Bsdf on run.threads() threads: the same bits for any number. The stage is "preparing the
/// BRDF"; takes below a second, several when not isotropic. Throws Error(Usage, "brdf") for other
/// than 1 or 3 channels, Error(Usage, "theta_nodes" | "phi_nodes" | "resolution"), Error(Stopped).
std::shared_ptr<const BakedBrdf> bake_brdf(const Bsdf& brdf, Run& run,
                                           const BakeSettings& settings = {});

/// The BRDF of a Measurement, between its layers as make_tabulated_brdf has it (tabulated.h) up to
/// what the tables round: quicker than baking that, as the factors that keep the albedo are found
/// once and not twice. Its errors besides those above are those of make_tabulated_brdf.
std::shared_ptr<const BakedBrdf> bake_brdf(const Measurement& measurement, Run& run,
                                           const BakeSettings& settings = {});

}  // namespace asperity

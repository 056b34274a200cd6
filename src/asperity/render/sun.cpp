// SPDX-License-Identifier: Apache-2.0
#include <asperity/core/directions.h>
#include <asperity/render/colour.h>
#include <asperity/render/sun.h>

#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace asperity {

namespace {

// Wavelengths in bands of 10 nm from here on.
constexpr double kFirstWavelength = 380, kBand = 10;
constexpr std::size_t kBands = 40;

/// Light of the sun outside the air, mean of each band [W/(m^2 nm)]: ASTM G173-03, column
/// "extraterrestrial".
constexpr std::array<double, kBands> kSunOutsideAir = {
    1.01249, 1.14716, 1.72765, 1.73054, 1.68870, 1.61253, 1.91198, 2.03474, 2.02042, 2.02212,
    1.93377, 1.95809, 1.91686, 1.82980, 1.86850, 1.89310, 1.85149, 1.85040, 1.83410, 1.83450,
    1.81470, 1.78158, 1.75330, 1.69650, 1.68194, 1.64654, 1.60480, 1.52143, 1.55622, 1.51130,
    1.47400, 1.44820, 1.41018, 1.36775, 1.34188, 1.31429, 1.28303, 1.26758, 1.23670, 1.20820};

/// Absorption by ozone at the edges of the bands [1/cm]: Preetham et al. 1999, table 2.
constexpr std::array<double, kBands + 1> kOzone = {
    0.000, 0.000, 0.000, 0.000, 0.000, 0.000, 0.000, 0.003, 0.006, 0.009, 0.014,
    0.021, 0.030, 0.040, 0.048, 0.063, 0.075, 0.085, 0.103, 0.120, 0.120, 0.115,
    0.125, 0.120, 0.105, 0.090, 0.079, 0.067, 0.057, 0.048, 0.036, 0.028, 0.023,
    0.018, 0.014, 0.011, 0.010, 0.009, 0.007, 0.004, 0.000};

/// A lobe of the fits below: `slopes` are 1 / width below and above the middle [1/nm].
double lobe(double wavelength, double middle, double slope_below, double slope_above) {
    const double t = (wavelength - middle) * (wavelength < middle ? slope_below : slope_above);
    return std::exp(-0.5 * t * t);
}

// CIE 1931 colour matching functions: the multi-lobe fits of Wyman, Sloan and Shirley 2013, "Simple
// analytic approximations to the CIE XYZ color matching functions", table 1.
double matching_x(double nm) {
    return 0.362 * lobe(nm, 442.0, 0.0624, 0.0374) + 1.056 * lobe(nm, 599.8, 0.0264, 0.0323) -
           0.065 * lobe(nm, 501.1, 0.0490, 0.0382);
}
double matching_y(double nm) {
    return 0.821 * lobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * lobe(nm, 530.9, 0.0613, 0.0322);
}
double matching_z(double nm) {
    return 1.217 * lobe(nm, 437.0, 0.0845, 0.0278) + 0.681 * lobe(nm, 459.0, 0.0385, 0.0725);
}

/// What the air lets through at a wavelength [nm], for `mass` of air, 1 when the sun is overhead.
double transmittance(double nm, double ozone, double mass, double turbidity) {
    constexpr double kOzoneLayer = 0.35;  // cm
    const double um = 1e-3 * nm;
    const double beta = 0.04608 * turbidity - 0.04586;  // Angstrom's turbidity coefficient
    const double rayleigh = 0.008735 * std::pow(um, -4.08);
    const double aerosol = beta * std::pow(um, -1.3);
    return std::exp(-mass * (rayleigh + aerosol + ozone * kOzoneLayer));
}

class DiscLight final : public Light {
  public:
    DiscLight(Vec3 direction, double diameter, Rgb irradiance, std::string name)
        : z_(direction), name_(std::move(name)) {
        // Any frame about the direction
        const Vec3 aside = std::abs(z_.y) < 0.9 ? Vec3{0, 1, 0} : Vec3{1, 0, 0};
        x_ = normalize(cross(aside, z_));
        y_ = cross(z_, x_);
        const double s = std::sin(0.25 * diameter);
        drop_ = 2 * s * s;
        pdf_ = 1 / (2 * kPi * drop_);
        // Integral of the cosine over the disc: pi sin^2 of its radius
        const double radius = std::sin(0.5 * diameter);
        radiance_ = (1 / (kPi * radius * radius)) * irradiance;
    }

    std::string name() const override { return name_; }

    std::optional<LightSample> sample(Vec3, double u1, double u2) const override {
        if (is_black(radiance_)) return std::nullopt;
        const double below = u1 * drop_;  // 1 - cos of the angle from the middle
        const double r = std::sqrt(below * (2 - below)), phi = 2 * kPi * u2;
        const Vec3 direction =
            (r * std::cos(phi)) * x_ + (r * std::sin(phi)) * y_ + (1 - below) * z_;
        return LightSample{direction, std::numeric_limits<double>::infinity(), radiance_, pdf_};
    }

    Rgb radiance(Vec3 direction) const override { return covers(direction) ? radiance_ : Rgb{}; }
    double pdf(Vec3 direction) const override {
        return covers(direction) && !is_black(radiance_) ? pdf_ : 0;
    }
    double weight() const override { return 0.25 * luminance(radiance_) / pdf_; }

  private:
    /// Half the squared chord is 1 - cos, without its cancellation.
    bool covers(Vec3 direction) const {
        constexpr double kRounding = 1 + 1e-9;
        const Vec3 chord = direction - z_;
        return 0.5 * dot(chord, chord) <= kRounding * drop_;
    }

    Vec3 x_, y_, z_;
    Rgb radiance_;
    double drop_ = 0;  ///< 1 - cos of the disc's radius
    double pdf_ = 0;
    std::string name_;
};

}  // namespace

Rgb sun_irradiance(double elevation, double turbidity) {
    // Mass of air: Kasten's formula, as in the paper
    const double zenith = 0.5 * kPi - elevation;
    const double mass =
        1 / (std::sin(elevation) + 0.15 * std::pow(93.885 - degrees(zenith), -1.253));

    double x = 0, y = 0, z = 0;
    for (std::size_t band = 0; band < kBands; ++band) {
        const double nm = kFirstWavelength + kBand * (static_cast<double>(band) + 0.5);
        const double ozone = 0.5 * (kOzone[band] + kOzone[band + 1]);
        const double light = kSunOutsideAir[band] * transmittance(nm, ozone, mass, turbidity);
        x += light * matching_x(nm);
        y += light * matching_y(nm);
        z += light * matching_z(nm);
    }
    constexpr double kKiloLumen = 683e-3 * kBand;  // of one watt at 555 nm, times the band
    return rgb_of_xyz(kKiloLumen * x, kKiloLumen * y, kKiloLumen * z);
}

std::unique_ptr<Light> make_disc_light(Vec3 direction, double diameter, Rgb irradiance,
                                       std::string name) {
    return std::make_unique<DiscLight>(direction, diameter, irradiance, std::move(name));
}

}  // namespace asperity

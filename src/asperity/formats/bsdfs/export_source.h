// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <asperity/bsdf/bsdf.h>
#include <asperity/core/run.h>
#include <asperity/gonio/measurement.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace asperity::io {

/// Where a format that is isotropic takes its values from: `bsdf` averaged over `azimuths` incident
/// azimuths (outgoing ones relative to them) and over both sides of the plane of incidence,
///
///     f(theta_i, theta_o, phi) = mean over k and sign of f(turned by phi_k, theta_o, +-phi)
///
/// which leaves a BSDF that is isotropic and mirror-symmetric as it is. `azimuths` = 1 for one that
/// is isotropic already.
std::shared_ptr<const Bsdf> isotropic_mean(std::shared_ptr<const Bsdf> bsdf, int azimuths);

/// The BSDF, whose eval() and eval_pdf() throw Error(Stopped) once the run is asked to stop.
std::shared_ptr<const Bsdf> until_stopped(std::shared_ptr<const Bsdf> bsdf, const Run& run);

/// What an export starts from: a measurement, or any Bsdf, as a continuous function, with the
/// incident directions it knows and the sentences that tell where it comes from.
///
/// Not thread-safe while functions are called for the first time: they compute what they give.
class ExportSource {
  public:
    /// Directions beyond the layers are filled in as make_tabulated_brdf says.
    ExportSource(std::shared_ptr<const Measurement> measurement, int threads);
    /// `experiment` gives the incident directions and the detector that the fidelity is taken on.
    ExportSource(std::shared_ptr<const Bsdf> bsdf, const Experiment& experiment, int threads);

    /// From now on the functions of the source, and with them the formats that are made of them,
    /// throw Error(Stopped) once `run`, which must live as long, is asked to stop: a writer ends
    /// within milliseconds and leaves no file. Before the functions are called for the first time.
    void watch(const Run& run) { run_ = &run; }
    const Run* watched() const { return run_; }
    /// For loops of a writer that call none of the functions.
    void check_stopped() const;

    /// Null for a source that is a Bsdf.
    const Measurement* measurement() const { return measurement_.get(); }
    /// f of the source; takes a second or more at the first call for a measurement.
    const Bsdf& bsdf() const;
    /// The same as a format without azimuths can hold it; see isotropic_mean().
    const Bsdf& isotropic_bsdf() const;

    /// True when turning wi and wo together changes nothing, or when it was measured at one azimuth
    /// only, which is then taken to stand for all.
    bool isotropic() const;
    int channels() const { return static_cast<int>(channel_names_.size()); }
    const std::vector<std::string>& channel_names() const { return channel_names_; }
    /// Incident polar angles and azimuths that were measured, rising, without repetition [rad].
    const std::vector<double>& thetas() const { return thetas_; }
    const std::vector<double>& phis() const { return phis_; }
    const Experiment& experiment() const { return experiment_; }
    int threads() const { return threads_; }

    /// Which channels stand for red, green and blue: all the same for one; for three those, the
    /// longest wavelength first where they have one. Throws Error(Usage, "format") for other
    /// numbers, naming the formats that take wavelengths.
    std::array<int, 3> rgb_channels() const;
    /// Wavelengths of the channels [nm]; empty when they are not named by them.
    std::vector<double> wavelengths_nm() const;
    /// How much each channel counts towards luminance (Rec. 709 for three, else alike); sum 1.
    std::vector<double> luminance_weights() const;

    /// Lines for the comments of a file: version, checksum or model, the experiment as settings.
    std::vector<std::string> provenance() const;
    /// What every export should be told of its own data: isotropic by assumption, and such.
    std::vector<std::string> remarks() const;

  private:
    void take_angles();

    std::shared_ptr<const Measurement> measurement_;
    Experiment experiment_;
    int threads_;
    std::vector<std::string> channel_names_;
    std::vector<double> thetas_, phis_;
    const Run* run_ = nullptr;
    mutable bool guarded_ = false;  ///< bsdf_ asks the run
    mutable std::shared_ptr<const Bsdf> bsdf_, isotropic_bsdf_;
};

}  // namespace asperity::io
